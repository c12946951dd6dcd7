#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/control/joint_angles.h"
#include "common/motion/jerk_limited_motion.h"

namespace puck {

/// The last look at set-points before they are sent: finite, between the joint's ends, and, by
/// their differences, within its velocity, acceleration and jerk. What made them should see to that
/// already; this does not rely on it. One thread.
class JointGuard {
 public:
  /// deg, deg/s, deg/s², deg/s³: of each joint.
  explicit JointGuard(std::vector<MotionLimits> limits);

  /// The joints rest there: the differences begin anew.
  void restart(const JointAngles& deg);

  /// Whether a set-point `dt_s` after the one before may be sent. What is refused counts for
  /// nothing afterwards.
  bool allows(const JointAngles& deg, double dt_s);

  /// Which joint broke which limit at the last refusal.
  const std::string& refusal() const { return refusal_; }

 private:
  bool refuse(std::size_t joint, const char* what);

  struct Joint {
    double deg = 0;
    double velocity = 0;
    double acceleration = 0;
  };

  std::vector<MotionLimits> limits_;
  std::array<Joint, JointAngles::kMost> last_{};
  double last_dt_s_ = 0;  // between the last two, and the two before
  double dt_before_s_ = 0;
  std::string refusal_;
};

}  // namespace puck
