#include "common/simulation/simulated_arm.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

constexpr double kLongestStep_s = 1e-3;

void require_positive(double value, const std::string& key) {
  if (!(value > 0)) {
    throw std::invalid_argument(key + " must be more than 0, got " + std::to_string(value));
  }
}

}  // namespace

SimulatedArm::SimulatedArm(const SimulatedArmParams& params, double half_line_m)
    : params_(params), half_line_m_(half_line_m) {
  require_positive(params.max_speed_m_s, "arm.max_speed_m_s");
  require_positive(params.max_acceleration_m_s2, "arm.max_acceleration_m_s2");
  require_positive(params.stiffness_1_s, "arm.stiffness_1_s");
  require_positive(half_line_m, "table.robot_line_half_m");
}

void SimulatedArm::set_target(double target_m) {
  if (!std::isfinite(target_m)) return;
  target_m_ = std::clamp(target_m, -half_line_m_, half_line_m_);
  holding_ = false;
}

void SimulatedArm::hold() { holding_ = true; }

void SimulatedArm::step(double dt_s) {
  const int steps = static_cast<int>(std::ceil(dt_s / kLongestStep_s));
  for (int i = 0; i < steps; ++i) small_step(dt_s / steps);
}

void SimulatedArm::small_step(double dt_s) {
  double wanted_m_s = 0;
  if (!holding_) {
    // As fast as the stiffness asks for, but no faster than the arm can still brake from.
    const double offset_m = target_m_ - position_m_;
    const double brakeable_m_s = std::sqrt(2 * params_.max_acceleration_m_s2 * std::abs(offset_m));
    const double limit_m_s = std::min(
        {params_.max_speed_m_s, brakeable_m_s, params_.stiffness_1_s * std::abs(offset_m)});
    wanted_m_s = std::copysign(limit_m_s, offset_m);
  }
  const double most_m_s = params_.max_acceleration_m_s2 * dt_s;
  velocity_m_s_ += std::clamp(wanted_m_s - velocity_m_s_, -most_m_s, most_m_s);
  position_m_ += velocity_m_s_ * dt_s;
  if (std::abs(position_m_) > half_line_m_) {
    position_m_ = std::copysign(half_line_m_, position_m_);
    velocity_m_s_ = 0;
  }
  if (holding_) target_m_ = position_m_;
}

}  // namespace puck
