#pragma once

#include <optional>

#include "common/simulation/game_params.h"
#include "common/simulation/puck_physics.h"
#include "common/simulation/random.h"

namespace puck {

/// Where and how a mallet has to meet the puck so that the puck flies as wanted.
struct Strike {
  TablePoint contact;        ///< Of the mallet's centre.
  TableVelocity at_contact;  ///< Of the mallet.
  TablePoint puck;           ///< Of the puck's centre.
};

/// Picks shots at the robot's goal: direct, or by a side rail.
class ShotPlanner {
 public:
  ShotPlanner(const PuckPhysics& physics, const GameParams& params, Random random);

  /// Draws where the next shot goes and how fast.
  void draw();
  /// The drawn shot for a puck met in this state; nothing when the mallet could not get there.
  std::optional<Strike> strike(const DiscState& puck) const;

 private:
  TableVelocity wanted_velocity(TablePoint from) const;

  PuckPhysics physics_;
  GameParams params_;
  Random random_;
  double aim_y_m_ = 0;
  double speed_m_s_ = 0;
  double error_rad_ = 0;
  int rail_ = 0;  ///< −1 and 1: by the rail at that side; 0: direct.
};

}  // namespace puck
