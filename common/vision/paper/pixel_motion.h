#pragma once

#include <array>

#include "common/events/timestamp.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

struct PixelMotionParams {
  /// Spectral density of the puck's acceleration, px²/s³. Larger follows hits and bounces
  /// sooner, smaller smooths more.
  double acceleration_density = 1e6;
  /// Standard deviation of a measured position, px.
  double measurement_sigma_px = 0.7;
};

/// The puck's position and velocity in the image: a Kalman filter with constant velocity and white
/// acceleration for each axis; the axes are uncorrelated and have the same variances.
class PixelMotion {
 public:
  explicit PixelMotion(const PixelMotionParams& params) : params_(params) {}

  /// Restarts at a position, with zero velocity and a large variance.
  void start(Pixel position, Timestamp time);
  /// Takes a measured position. Times must not go backwards.
  void measure(Pixel position, Timestamp time);
  /// Predicted position at `time`.
  Pixel expected_at(Timestamp time) const;

  Pixel position() const { return position_; }
  PixelVelocity velocity() const { return velocity_; }
  /// Covariance of (x, y, vx, vy), row by row; px², px²/s, px²/s². As of the last measurement.
  std::array<double, 16> covariance() const;

 private:
  double measurement_variance() const {
    return params_.measurement_sigma_px * params_.measurement_sigma_px;
  }

  PixelMotionParams params_;
  Timestamp time_;
  Pixel position_;
  PixelVelocity velocity_;
  // Variance of the position, covariance with the velocity, variance of the velocity.
  double pp_ = 0;
  double pv_ = 0;
  double vv_ = 0;
};

}  // namespace puck
