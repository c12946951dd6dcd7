#pragma once

#include "common/motion/jerk_limited_motion.h"
#include "common/simulation/simulated_arm_params.h"

namespace puck {

/// The mallet on the robot's line as an arm moves it that does what it is told: to its target in
/// the shortest time within its limits.
class SimulatedArm {
 public:
  /// The line reaches from −`half_line_m` to `half_line_m`; the arm starts in the middle, at rest.
  /// Throws std::invalid_argument for a parameter that is not positive.
  SimulatedArm(const SimulatedArmParams& params, double half_line_m);

  /// y on the line; clamped to it, ignored when not finite.
  void set_target(double target_m) { motion_.set_target(target_m); }
  /// Brakes as hard as the limits allow and stays where it comes to rest, until the next target.
  void hold() { motion_.hold(); }
  /// Moves on by `dt_s`, which may be anything from 0.
  void step(double dt_s) { motion_.step(dt_s); }

  double position_m() const { return motion_.state().position; }
  double velocity_m_s() const { return motion_.state().velocity; }
  double target_m() const { return motion_.target(); }

 private:
  JerkLimitedMotion motion_;
};

}  // namespace puck
