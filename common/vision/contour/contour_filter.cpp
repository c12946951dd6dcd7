#include "common/vision/contour/contour_filter.h"

#include <algorithm>
#include <cmath>

namespace puck {

ContourFilter::ContourFilter(const ContourFilterParams& params, const Start& start,
                             std::int64_t time_us)
    : params_(params),
      time_us_(time_us),
      state_{start.position.x, start.position.y, start.velocity.x, start.velocity.y,
             start.growth_px} {
  cov(0, 0) = cov(1, 1) = start.sigma_px * start.sigma_px;
  cov(2, 2) = cov(3, 3) = start.sigma_px_s * start.sigma_px_s;
  cov(4, 4) = start.growth_variance_px2;
}

ContourFilter::Start ContourFilter::start_at(Pixel position) const {
  Start start;
  start.position = position;
  start.growth_px = state_[4];
  start.growth_variance_px2 = cov(4, 4);
  return start;
}

void ContourFilter::give_slack(double px) {
  if (px == slack_px_) return;
  slack_px_ = px;
  keep_in_bounds();
}

void ContourFilter::predict(std::int64_t time_us, double damping_s) {
  const double dt = static_cast<double>(time_us - time_us_) * 1e-6;
  if (!(dt > 0)) return;
  time_us_ = time_us;
  const double keep = 1 - std::min(dt / damping_s, 1.0);
  state_[0] += dt * state_[2];
  state_[1] += dt * state_[3];
  state_[2] *= keep;
  state_[3] *= keep;

  for (std::size_t i = 0; i < kSize; ++i) {
    cov(0, i) += dt * cov(2, i);
    cov(1, i) += dt * cov(3, i);
  }
  for (std::size_t i = 0; i < kSize; ++i) {
    cov(i, 0) += dt * cov(i, 2);
    cov(i, 1) += dt * cov(i, 3);
  }
  const double q = params_.acceleration_density;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    cov(axis, axis) += q * dt * dt * dt / 3;
    cov(axis, axis + 2) += q * dt * dt / 2;
    cov(axis + 2, axis) += q * dt * dt / 2;
    cov(axis + 2, axis + 2) += q * dt;
  }
  const double share = std::min(dt / params_.growth_time_s, 1.0);
  state_[4] *= 1 - share;
  for (std::size_t i = 0; i < 4; ++i) {
    cov(4, i) *= 1 - share;
    cov(i, 4) *= 1 - share;
  }
  cov(4, 4) += 2 * share * (params_.growth_sigma_px * params_.growth_sigma_px - cov(4, 4));
}

void ContourFilter::slow_down(double share, double seconds,
                              const std::array<double, 2>& variances) {
  for (std::size_t axis = 0; axis < 2; ++axis) {
    const std::size_t speed = axis + 2;
    state_[axis] -= (1 - share) * seconds * state_[speed];
    state_[speed] *= share;
    scale(speed, share);
    const double grown = std::max(cov(axis, axis) - variances[axis], 0.0) * (1 - share * share);
    const double kept = std::max(cov(axis, axis) - grown, 1e-6);
    scale(axis, std::sqrt(kept / cov(axis, axis)));
  }
}

// Multiplies a component's error.
void ContourFilter::scale(std::size_t component, double factor) {
  for (std::size_t i = 0; i < kSize; ++i) {
    cov(component, i) *= factor;
    cov(i, component) *= factor;
  }
}

double ContourFilter::distance_variance(double normal_x, double normal_y) const {
  return normal_x * (normal_x * cov(0, 0) + 2 * (normal_y * cov(0, 1) + cov(0, 4))) +
         normal_y * (normal_y * cov(1, 1) + 2 * cov(1, 4)) + cov(4, 4);
}

double ContourFilter::speed_variance(double normal_x, double normal_y) const {
  return normal_x * (normal_x * cov(2, 2) + 2 * normal_y * cov(2, 3)) +
         normal_y * normal_y * cov(3, 3);
}

void ContourFilter::correct(double distance_px, double normal_x, double normal_y, double share) {
  State ph;
  for (std::size_t i = 0; i < kSize; ++i) {
    ph[i] = normal_x * cov(i, 0) + normal_y * cov(i, 1) + cov(i, 4);
  }
  // Distant events weigh less, without a threshold.
  const double variance = params_.event_variance_px2 * (1 + distance_px * distance_px / 4) / share;
  const double per_innovation = 1 / (normal_x * ph[0] + normal_y * ph[1] + ph[4] + variance);
  for (std::size_t i = 0; i < kSize; ++i) state_[i] += ph[i] * per_innovation * distance_px;
  for (std::size_t i = 0; i < kSize; ++i) {
    for (std::size_t j = 0; j < kSize; ++j) cov(i, j) -= ph[i] * ph[j] * per_innovation;
  }
  keep_in_bounds();
}

void ContourFilter::keep_in_bounds() {
  state_[4] =
      std::clamp(state_[4], params_.smallest_growth_px, params_.largest_growth_px + slack_px_);
  // The square root only above the bound: this runs for every event.
  const double squared_speed = state_[2] * state_[2] + state_[3] * state_[3];
  if (squared_speed > params_.max_speed_px_s * params_.max_speed_px_s) {
    const double keep = params_.max_speed_px_s / std::sqrt(squared_speed);
    state_[2] *= keep;
    state_[3] *= keep;
  }
}

Pixel ContourFilter::position_at(std::int64_t time_us) const {
  const double dt = static_cast<double>(std::min<std::int64_t>(time_us - time_us_, 0)) * 1e-6;
  return {state_[0] + dt * state_[2], state_[1] + dt * state_[3]};
}

double ContourFilter::speed_px_s() const { return std::hypot(state_[2], state_[3]); }

std::array<double, 16> ContourFilter::covariance() const {
  std::array<double, 16> values;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) values[4 * i + j] = cov(i, j);
  }
  return values;
}

}  // namespace puck
