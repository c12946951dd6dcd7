#include "common/control/arm_motion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace puck {
namespace {

// Joints nearer to the line than this count as on it: a step of this size breaks no limit.
constexpr double kOnLineDeg = 1e-9;
// The approach reaches its speed in 0.2 s, and that acceleration in 0.1 s.
constexpr double kApproachRampS = 0.2;
constexpr double kApproachEaseS = 0.1;

void require(bool ok, const std::string& message) {
  if (!ok) throw std::invalid_argument(message);
}

ArmMotionParams checked(const ArmMotionParams& params, double line_half_m) {
  const auto is_positive = [](double value) { return std::isfinite(value) && value > 0; };
  require(is_positive(line_half_m), "arm.line_half_m must be above 0");
  require(is_positive(params.max_speed_m_s), "arm.max_speed_m_s must be above 0");
  require(is_positive(params.max_acceleration_m_s2), "arm.max_acceleration_m_s2 must be above 0");
  require(is_positive(params.max_jerk_m_s3), "arm.max_jerk_m_s3 must be above 0");
  require(is_positive(params.approach_deg_s), "arm.approach_deg_s must be above 0");
  require(is_positive(params.max_tracking_error_deg), "arm.max_tracking_error_deg must be above 0");
  require(params.max_encoder_age_us >= 1, "arm.max_encoder_age_ms must be above 0");
  constexpr double kSameM = 1e-9;
  require(
      params.joints.from_m <= -line_half_m + kSameM && params.joints.to_m >= line_half_m - kSameM,
      "arm.line_half_m exceeds the range of arm.joint_table, " +
          std::to_string(params.joints.from_m) + " to " + std::to_string(params.joints.to_m) +
          " m");
  return params;
}

std::vector<MotionLimits> limits_of(const JointTable& table) {
  std::vector<MotionLimits> limits;
  for (std::size_t k = 0; k < table.size(); ++k) limits.push_back(table.limits(k));
  return limits;
}

}  // namespace

ArmMotion::ArmMotion(const ArmMotionParams& params, double line_half_m)
    : params_(checked(params, line_half_m)),
      table_(params_.joints),
      encoders_(table_),
      guard_(limits_of(table_)),
      line_(table_.line_limits({-line_half_m, line_half_m, params_.max_speed_m_s,
                                params_.max_acceleration_m_s2, params_.max_jerk_m_s3}),
            0),
      approach_(approach_over(1)) {}

JerkLimitedMotion ArmMotion::approach_over(double distance_deg) const {
  const double speed = params_.approach_deg_s;
  MotionLimits limits{0, distance_deg, speed, speed / kApproachRampS,
                      speed / (kApproachRampS * kApproachEaseS)};
  for (std::size_t k = 0; k < table_.size(); ++k) {
    const MotionLimits& joint = table_.limits(k);
    limits.velocity = std::min(limits.velocity, joint.velocity);
    limits.acceleration = std::min(limits.acceleration, joint.acceleration);
    limits.jerk = std::min(limits.jerk, joint.jerk);
  }
  return {limits, 0};
}

std::string ArmMotion::note() const {
  switch (phase_) {
    case Phase::kWaiting:
      if (encoders_.has_reading()) return "waiting for stable encoder readings";
      return "waiting for the encoders" + (awaited_.empty() ? "" : ": " + awaited_);
    case Phase::kApproach:
      return "moving to the line";
    case Phase::kOnLine:
      break;
  }
  return {};
}

bool ArmMotion::set_points_rest() const {
  if (phase_ == Phase::kWaiting || is_silenced_) return true;
  return phase_ == Phase::kApproach ? approach_.is_at_rest() : line_.is_at_rest();
}

void ArmMotion::rest() {
  if (phase_ == Phase::kWaiting) return;
  line_.rest_at(line_.state().position);
  approach_.rest_at(approach_.state().position);
  guard_.restart(set_point_);
}

// The fault first, since the readings of a back end with a fault are not reliable.
std::string ArmMotion::trouble(ArmBackEnd& back_end, std::int64_t monotonic_us, bool may_take) {
  if (std::string fault = back_end.fault(monotonic_us); !fault.empty()) {
    is_silenced_ = true;
    return fault;
  }
  const std::optional<JointReading> reading = back_end.reading(monotonic_us);
  if (const char* wrong = encoders_.look(reading)) return wrong;
  if (!reading) {
    awaited_ = back_end.awaited();
    if (!awaited_.empty()) wait_anew();
  }
  if (!encoders_.has_reading()) return {};
  if (encoders_.age_us(monotonic_us) > params_.max_encoder_age_us) {
    // Before the start, old readings are dropped until a fresh one comes.
    if (phase_ != Phase::kWaiting) return "encoders silent";
    forget_encoders();
    return {};
  }
  if (phase_ == Phase::kWaiting) {
    return may_take && start_.see(encoders_.newest()) ? begin() : std::string{};
  }
  for (std::size_t k = 0; k < set_point_.size(); ++k) {
    if (std::abs(encoders_.deg()[k] - set_point_[k]) <= params_.max_tracking_error_deg) continue;
    return "joint " + std::to_string(k) + " does not follow its set-point: the encoder reads " +
           std::to_string(encoders_.deg()[k]) + " deg, the set-point is " +
           std::to_string(set_point_[k]);
  }
  return {};
}

void ArmMotion::wait_anew() {
  phase_ = Phase::kWaiting;
  forget_encoders();
}

void ArmMotion::forget_encoders() {
  encoders_.restart();
  start_.restart();
}

// The first set-point is the arm's own position, so that the start causes no jump.
std::string ArmMotion::begin() {
  const JointAngles& at = encoders_.deg();
  for (std::size_t k = 0; k < at.size(); ++k) {
    const MotionLimits& limits = table_.limits(k);
    if (at[k] >= limits.lowest && at[k] <= limits.highest) continue;
    return "joint " + std::to_string(k) + " stands at " + std::to_string(at[k]) +
           " deg, outside its limits: move it by hand";
  }
  encoders_.find_place();
  line_.rest_at(encoders_.place().y_m);
  approach_from_ = set_point_ = at;
  approach_to_ = joints_at(table_, line_.state().position);
  approach_deg_ = 0;
  for (std::size_t k = 0; k < at.size(); ++k) {
    approach_deg_ = std::max(approach_deg_, std::abs(approach_to_[k] - at[k]));
  }
  phase_ = Phase::kOnLine;
  if (approach_deg_ > kOnLineDeg) {
    phase_ = Phase::kApproach;
    approach_ = approach_over(approach_deg_);
  }
  guard_.restart(at);
  return {};
}

JointAngles ArmMotion::next_set_point(std::optional<double> target_m, double dt_s) {
  JointAngles next = set_point_;
  if (phase_ == Phase::kApproach) {
    if (!target_m || !approach_.set_target(approach_deg_)) approach_.hold();
    approach_.step(dt_s);
    const double share = approach_.state().position / approach_deg_;
    for (std::size_t k = 0; k < next.size(); ++k) {
      next[k] = approach_from_[k] + share * (approach_to_[k] - approach_from_[k]);
    }
    if (share == 1) {
      next = approach_to_;
      phase_ = Phase::kOnLine;
    }
    return next;
  }
  if (!target_m || !line_.set_target(*target_m)) line_.hold();
  line_.step(dt_s);
  return joints_at(table_, line_.state().position);
}

std::string ArmMotion::step(ArmBackEnd& back_end, std::optional<double> target_m,
                            std::int64_t monotonic_us, double dt_s, bool may_take) {
  if (wants_restart_) {
    target_m.reset();
    if (set_points_rest()) {
      wants_restart_ = is_silenced_ = false;
      wait_anew();
    }
  }
  if (phase_ != Phase::kWaiting && !is_silenced_ && !back_end.holds()) {
    // Set-points have no effect yet, so the motion must neither brake nor run ahead.
    target_m.reset();
    if (!may_take) wait_anew();
  }
  std::string wrong = trouble(back_end, monotonic_us, may_take);
  if (!wrong.empty()) target_m.reset();
  if (phase_ == Phase::kWaiting || is_silenced_) {
    back_end.withdraw();
    return wrong;
  }
  const JointAngles next = next_set_point(target_m, dt_s);
  if (!guard_.allows(next, dt_s)) {
    is_silenced_ = true;
    back_end.withdraw();
    return wrong.empty() ? guard_.refusal() : wrong;
  }
  set_point_ = next;
  back_end.command(set_point_, monotonic_us);
  return wrong;
}

}  // namespace puck
