#include "common/vision/paper/motion_lead.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace puck {

void EdgeTrail::learn(double spread_px, double speed_px_s, Timestamp time) {
  const double elapsed_ms = static_cast<double>(time - learned_at_) * 1e-3;
  learned_at_ = time;
  const double blur_px = params_.blur_us * 1e-6 * speed_px_s;
  const double length = std::clamp(
      (spread_px - blur_px - params_.short_px) / (params_.long_px - params_.short_px), 0.0, 1.0);
  // After a pause the last millisecond counts no more than another.
  const double share = std::clamp(elapsed_ms, 0.0, 10.0) / params_.learning_ms;
  length_ += std::min(share, 1.0) * (length - length_);
}

LedPosition lead_forward(Pixel position, PixelVelocity velocity,
                         const std::array<double, 16>& covariance, double lag_us, double trail,
                         const MotionLeadParams& params) {
  LedPosition led{position, covariance};
  if (!params.enabled) return led;
  const double per_speed = 1 / std::hypot(std::hypot(velocity.x, velocity.y), params.slow_px_s);
  const double longer = 1 + params.trail_gain * trail;
  const double lead_s =
      (lag_us + longer * params.edge_us) * 1e-6 + longer * params.edge_px * per_speed;
  led.position = {position.x + lead_s * velocity.x, position.y + lead_s * velocity.y};

  // F P Fᵀ with position' = position + lead · velocity …
  std::array<double, 16>& c = led.covariance;
  const auto at = [&c](std::size_t row, std::size_t column) -> double& {
    return c[4 * row + column];
  };
  for (std::size_t column = 0; column < 4; ++column) {
    for (const std::size_t axis : {0, 1}) at(axis, column) += lead_s * at(axis + 2, column);
  }
  for (std::size_t row = 0; row < 4; ++row) {
    for (const std::size_t axis : {0, 1}) at(row, axis) += lead_s * at(row, axis + 2);
  }
  // … and, along the motion, what is not known of the lags.
  const double edge_s = params.edge_sigma_px * per_speed;
  const double lag_s = params.lag_sigma_us * 1e-6;
  const double unknown_s2 = edge_s * edge_s + lag_s * lag_s;
  at(0, 0) += unknown_s2 * velocity.x * velocity.x;
  at(0, 1) += unknown_s2 * velocity.x * velocity.y;
  at(1, 0) += unknown_s2 * velocity.x * velocity.y;
  at(1, 1) += unknown_s2 * velocity.y * velocity.y;
  const double trail_px = trail * params.trail_sigma_px;
  at(0, 0) += trail_px * trail_px;
  at(1, 1) += trail_px * trail_px;
  return led;
}

}  // namespace puck
