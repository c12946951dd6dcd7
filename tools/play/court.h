#pragma once

#include <cstdint>
#include <memory>

#include "common/simulation/simulated_truth.h"
#include "common/table/homography.h"
#include "common/vision/interfaces/puck_estimate.h"
#include "tools/play/play_setup.h"

namespace puck {

/// The table with the game, and the tracker. One thread.
class Court {
 public:
  virtual ~Court() = default;

  /// Advances the world by one step.
  virtual void advance() = 0;
  /// The world after the last step.
  virtual const SimulatedTruth& truth() const = 0;
  /// As SimulatedTable::set_robot_mallet.
  virtual void set_robot_mallet(double y_m) = 0;
  /// The tracker's current estimate.
  virtual PuckEstimate estimate() = 0;
};

/// With source kEvents the tracker gets events; otherwise estimates are the truth plus PUCK's
/// errors, and nothing is drawn. The same setup and seed give the same game for every source, up to
/// the robot's touch. Throws std::invalid_argument that names a value out of its range.
std::unique_ptr<Court> make_court(const PlaySetup& setup, std::int64_t seed);

/// Exact, for the plane of the puck's centre and the camera in its home pose.
Homography exact_table_from_image(const SimulationParams& world);

}  // namespace puck
