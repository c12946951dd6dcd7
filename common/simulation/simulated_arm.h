#pragma once

#include "common/motion/jerk_limited_motion.h"
#include "common/simulation/simulated_arm_params.h"

namespace puck {

/// The mallet on the robot's line, moved by an ideal arm: it reaches its target in the shortest
/// time within its limits.
class SimulatedArm {
 public:
  /// The line spans ±`half_line_m`; the arm starts in the middle, at rest. Throws
  /// std::invalid_argument for a parameter that is not positive.
  SimulatedArm(const SimulatedArmParams& params, double half_line_m);

  /// `target_m`: y on the line, m; clamped to the line, ignored when not finite.
  void set_target(double target_m) { motion_.set_target(target_m); }
  /// Brakes as hard as the limits allow and stays at rest until the next target.
  void hold() { motion_.hold(); }
  /// Advances by `dt_s` >= 0.
  void step(double dt_s) { motion_.step(dt_s); }

  double position_m() const { return motion_.state().position; }
  double velocity_m_s() const { return motion_.state().velocity; }
  double target_m() const { return motion_.target(); }

 private:
  JerkLimitedMotion motion_;
};

}  // namespace puck
