#include "common/vision/paper/pixel_motion.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr double kStartSigmaPxPerS = 1000;  // of the unknown velocity at the start

double seconds_between(Timestamp from, Timestamp to) {
  return static_cast<double>(to - from) * 1e-6;
}

}  // namespace

void PixelMotion::Axis::predict(double dt, double acceleration_density) {
  const double q = acceleration_density;
  position += dt * velocity;
  pp += dt * (2 * pv + dt * vv) + q * dt * dt * dt / 3;
  pv += dt * vv + q * dt * dt / 2;
  vv += q * dt;
}

void PixelMotion::Axis::correct(double measured, double variance) {
  const double position_gain = pp / (pp + variance);
  const double velocity_gain = pv / (pp + variance);
  const double innovation = measured - position;
  position += position_gain * innovation;
  velocity += velocity_gain * innovation;
  vv -= velocity_gain * pv;
  pv *= 1 - position_gain;
  pp *= 1 - position_gain;
}

void PixelMotion::Axis::learn_anew(double measured, double variance) {
  position = measured;
  pp = variance;
  pv = 0;
  vv = std::max(vv, kStartSigmaPxPerS * kStartSigmaPxPerS);
}

void PixelMotion::start(Pixel position, Timestamp time) {
  const double variance = params_.measurement_sigma_px * params_.measurement_sigma_px;
  time_ = time;
  x_ = {};
  y_ = {};
  x_.learn_anew(position.x, variance);
  y_.learn_anew(position.y, variance);
}

void PixelMotion::measure(Pixel position, Timestamp time,
                          const std::optional<PixelVariance>& variance) {
  const double dt = seconds_between(time_, time);
  time_ = time;
  const double sigma2 = params_.measurement_sigma_px * params_.measurement_sigma_px;
  const PixelVariance noise = variance.value_or(PixelVariance{sigma2, sigma2});
  x_.predict(dt, params_.acceleration_density);
  y_.predict(dt, params_.acceleration_density);

  const double x_off = position.x - x_.position;
  const double y_off = position.y - y_.position;
  const double off2 = x_off * x_off / (x_.pp + noise.x) + y_off * y_off / (y_.pp + noise.y);
  if (params_.surprise_sigmas > 0 && off2 > params_.surprise_sigmas * params_.surprise_sigmas) {
    x_.learn_anew(position.x, noise.x);
    y_.learn_anew(position.y, noise.y);
    return;
  }
  x_.correct(position.x, noise.x);
  y_.correct(position.y, noise.y);
}

Pixel PixelMotion::expected_at(Timestamp time) const {
  const double dt = seconds_between(time_, time);
  return {x_.position + dt * x_.velocity, y_.position + dt * y_.velocity};
}

std::array<double, 16> PixelMotion::covariance() const {
  return {x_.pp, 0, x_.pv, 0,  //
          0, y_.pp, 0, y_.pv,  //
          x_.pv, 0, x_.vv, 0,  //
          0, y_.pv, 0, y_.vv};
}

}  // namespace puck
