#pragma once

#include "common/simulation/simulated_arm_params.h"

namespace puck {

/// The mallet on the robot's line as a follower of its target that does not overshoot: its speed
/// and acceleration limited, its place kept on the line.
class SimulatedArm {
 public:
  /// The line reaches from −`half_line_m` to `half_line_m`; the arm starts in the middle, at rest.
  /// Throws std::invalid_argument for a parameter that is not positive.
  SimulatedArm(const SimulatedArmParams& params, double half_line_m);

  /// y on the line; clamped to it, ignored when not finite.
  void set_target(double target_m);
  /// Brakes as hard as the limits allow and stays where it comes to rest, until the next target.
  void hold();
  /// Moves on by `dt_s`, which may be anything from 0.
  void step(double dt_s);

  double position_m() const { return position_m_; }
  double velocity_m_s() const { return velocity_m_s_; }
  double target_m() const { return target_m_; }

 private:
  void small_step(double dt_s);

  SimulatedArmParams params_;
  double half_line_m_;
  double position_m_ = 0;
  double velocity_m_s_ = 0;
  double target_m_ = 0;
  bool holding_ = false;
};

}  // namespace puck
