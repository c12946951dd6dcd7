#pragma once

#include <optional>

#include "common/simulation/game_params.h"
#include "common/simulation/puck_physics.h"
#include "common/simulation/random.h"

namespace puck {

/// Position and velocity with which a mallet must meet the puck for the drawn shot.
struct Strike {
  TablePoint contact;        ///< The mallet's centre.
  TableVelocity at_contact;  ///< The mallet's velocity.
  TablePoint puck;           ///< The puck's centre.
};

/// Draws shots at the robot's goal: direct, or off a side rail.
class ShotPlanner {
 public:
  ShotPlanner(const PuckPhysics& physics, const GameParams& params, Random random);

  /// Draws the aim, speed and error of the next shot.
  void draw();
  /// The drawn shot for a puck in this state; `std::nullopt` where the mallet cannot reach the
  /// contact point.
  std::optional<Strike> strike(const DiscState& puck) const;

 private:
  TableVelocity wanted_velocity(TablePoint from) const;

  PuckPhysics physics_;
  GameParams params_;
  Random random_;
  double aim_y_m_ = 0;
  double speed_m_s_ = 0;
  double error_rad_ = 0;
  int rail_ = 0;  ///< −1 or 1: off the side rail at that y; 0: direct.
};

}  // namespace puck
