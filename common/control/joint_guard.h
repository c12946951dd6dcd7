#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/control/joint_angles.h"
#include "common/motion/jerk_limited_motion.h"

namespace puck {

/// Last check of set-points before they are sent: finite, within the joint's range and, by their
/// differences, within its velocity, acceleration and jerk. Independent of the code that makes
/// them. One thread.
class JointGuard {
 public:
  /// Limits of each joint: deg, deg/s, deg/s², deg/s³.
  explicit JointGuard(std::vector<MotionLimits> limits);

  /// The joints rest at `deg`: the differences start again.
  void restart(const JointAngles& deg);

  /// Whether a set-point `dt_s` after the previous one may be sent. A refused set-point is not used
  /// in later differences.
  bool allows(const JointAngles& deg, double dt_s);

  /// Joint and limit of the last refusal.
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
