#include "common/control/joint_guard.h"

#include <cmath>
#include <utility>

namespace puck {
namespace {

// Tolerance for rounding, which the third difference divides by dt³.
constexpr double kRoundingDeg = 1e-11;
constexpr double kSlack = 1 + 1e-6;

}  // namespace

JointGuard::JointGuard(std::vector<MotionLimits> limits) : limits_(std::move(limits)) {}

void JointGuard::restart(const JointAngles& deg) {
  for (std::size_t k = 0; k < deg.size(); ++k) last_[k] = {deg[k], 0, 0};
  // Any earlier pace is over.
  last_dt_s_ = dt_before_s_ = 0;
}

bool JointGuard::refuse(std::size_t joint, const char* what) {
  refusal_ = "a set-point of joint " + std::to_string(joint) + " was " + what + ": not sent";
  return false;
}

bool JointGuard::allows(const JointAngles& deg, double dt_s) {
  if (deg.size() != limits_.size()) {
    return refuse(deg.size(), "unexpected (the joint table has another number of joints)");
  }
  if (!(dt_s > 0) || !std::isfinite(dt_s)) {
    return refuse(0, "not later than the set-point before it");
  }
  // Divided differences, times 1, 2 and 6, never exceed the derivatives' bounds, however uneven the
  // times are. At rest, the time steps before the first one are taken to be equal to it.
  const double one_s = last_dt_s_ > 0 ? last_dt_s_ : dt_s;
  const double two_s = dt_before_s_ > 0 ? dt_before_s_ : one_s;
  std::array<Joint, JointAngles::kMost> next{};
  for (std::size_t k = 0; k < limits_.size(); ++k) {
    const MotionLimits& limits = limits_[k];
    const Joint& last = last_[k];
    if (!std::isfinite(deg[k])) return refuse(k, "not finite");
    if (deg[k] < limits.lowest - kRoundingDeg || deg[k] > limits.highest + kRoundingDeg) {
      return refuse(k, "outside its limits");
    }
    const double velocity = (deg[k] - last.deg) / dt_s;
    const double acceleration = 2 * (velocity - last.velocity) / (dt_s + one_s);
    const double jerk = 3 * (acceleration - last.acceleration) / (dt_s + one_s + two_s);
    const double rounding = kRoundingDeg / dt_s;
    if (std::abs(velocity) > limits.velocity * kSlack + rounding) return refuse(k, "too fast");
    if (std::abs(acceleration) > limits.acceleration * kSlack + rounding / dt_s) {
      return refuse(k, "above its acceleration limit");
    }
    if (std::abs(jerk) > limits.jerk * kSlack + rounding / (dt_s * dt_s)) {
      return refuse(k, "above its jerk limit");
    }
    next[k] = {deg[k], velocity, acceleration};
  }
  last_ = next;
  dt_before_s_ = last_dt_s_;
  last_dt_s_ = dt_s;
  return true;
}

}  // namespace puck
