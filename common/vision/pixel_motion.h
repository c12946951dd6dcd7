#pragma once

#include <array>

#include "common/events/timestamp.h"
#include "common/vision/pixel.h"

namespace puck {

struct PixelMotionParams {
  /// Spectral density of the puck's acceleration, px²/s³. Larger follows hits and bounces sooner;
  /// smaller smooths more.
  double acceleration_density = 1e6;
  /// Standard deviation of a measured position, px.
  double measurement_sigma_px = 0.7;
};

/// The puck's position and velocity in the image: a Kalman filter with constant velocity and white
/// acceleration, the same for both axes, which do not influence each other.
class PixelMotion {
 public:
  explicit PixelMotion(const PixelMotionParams& params) : params_(params) {}

  /// Begins anew at a position, at rest as far as is known.
  void start(Pixel position, Timestamp time);
  /// Takes a measured position. Times must not go backwards.
  void measure(Pixel position, Timestamp time);
  /// Where the puck is expected at `time`.
  Pixel expected_at(Timestamp time) const;

  Pixel position() const { return position_; }
  PixelVelocity velocity() const { return velocity_; }
  /// Of (x, y, vx, vy), row by row; px², px²/s, px²/s². As of the last measurement.
  std::array<double, 16> covariance() const;

 private:
  PixelMotionParams params_;
  Timestamp time_;
  Pixel position_;
  PixelVelocity velocity_;
  // Of one axis: position, position with velocity, velocity.
  double pp_ = 0;
  double pv_ = 0;
  double vv_ = 0;
};

}  // namespace puck
