#pragma once

#include <cstdint>
#include <memory>

#include "common/simulation/simulated_truth.h"
#include "common/table/homography.h"
#include "common/vision/puck_estimate.h"
#include "tools/play/play_setup.h"

namespace puck {

/// The table with the game on it, and the tracker that watches it. One thread.
class Court {
 public:
  virtual ~Court() = default;

  /// Moves the world on by one step.
  virtual void advance() = 0;
  /// The world after it.
  virtual const SimulatedTruth& truth() const = 0;
  /// As SimulatedTable::set_robot_mallet.
  virtual void set_robot_mallet(double y_m) = 0;
  /// What the tracker says now.
  virtual PuckEstimate estimate() = 0;
};

/// With source kEvents the tracker sees events, else the truth with PUCK's errors on it, and
/// nothing is drawn. The same setup and seed make the same game, whatever the source, up to the
/// robot's touch. Throws std::invalid_argument that names a value out of its range.
std::unique_ptr<Court> make_court(const PlaySetup& setup, std::int64_t seed);

/// Of the plane in which the middle of the puck moves, with the camera in its home pose: exact.
Homography exact_table_from_image(const SimulationParams& world);

}  // namespace puck
