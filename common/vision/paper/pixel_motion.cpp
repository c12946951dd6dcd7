#include "common/vision/paper/pixel_motion.h"

namespace puck {
namespace {

constexpr double kStartSigmaPxPerS = 1000;  // of the unknown velocity at the start

double seconds_between(Timestamp from, Timestamp to) {
  return static_cast<double>(to - from) * 1e-6;
}

}  // namespace

void PixelMotion::start(Pixel position, Timestamp time) {
  time_ = time;
  position_ = position;
  velocity_ = {};
  pp_ = measurement_variance();
  pv_ = 0;
  vv_ = kStartSigmaPxPerS * kStartSigmaPxPerS;
}

void PixelMotion::measure(Pixel position, Timestamp time) {
  const double dt = seconds_between(time_, time);
  const double q = params_.acceleration_density;
  position_ = expected_at(time);
  time_ = time;
  pp_ += dt * (2 * pv_ + dt * vv_) + q * dt * dt * dt / 3;
  pv_ += dt * vv_ + q * dt * dt / 2;
  vv_ += q * dt;

  const double position_gain = pp_ / (pp_ + measurement_variance());
  const double velocity_gain = pv_ / (pp_ + measurement_variance());
  const Pixel off{position.x - position_.x, position.y - position_.y};
  position_ = {position_.x + position_gain * off.x, position_.y + position_gain * off.y};
  velocity_ = {velocity_.x + velocity_gain * off.x, velocity_.y + velocity_gain * off.y};
  vv_ -= velocity_gain * pv_;
  pv_ *= 1 - position_gain;
  pp_ *= 1 - position_gain;
}

Pixel PixelMotion::expected_at(Timestamp time) const {
  const double dt = seconds_between(time_, time);
  return {position_.x + dt * velocity_.x, position_.y + dt * velocity_.y};
}

std::array<double, 16> PixelMotion::covariance() const {
  return {pp_, 0,   pv_, 0,    //
          0,   pp_, 0,   pv_,  //
          pv_, 0,   vv_, 0,    //
          0,   pv_, 0,   vv_};
}

}  // namespace puck
