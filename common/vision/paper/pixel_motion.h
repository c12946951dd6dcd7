#pragma once

#include <array>
#include <optional>

#include "common/events/timestamp.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

struct PixelMotionParams {
  /// Spectral density of the puck's acceleration, px²/s³. Larger follows hits and bounces
  /// sooner, smaller smooths more.
  double acceleration_density = 1e6;
  /// Standard deviation of a measured position without a variance of its own, px.
  double measurement_sigma_px = 0.7;
  /// A measurement more standard deviations than this off the prediction means a hit or a bounce:
  /// the velocity is estimated anew. 0: never.
  double surprise_sigmas = 0;
};

/// Variances of a measured position, px²; its axes are uncorrelated.
struct PixelVariance {
  double x = 0;
  double y = 0;
};

/// The puck's position and velocity in the image: a Kalman filter with constant velocity and white
/// acceleration for each axis; the axes are uncorrelated.
class PixelMotion {
 public:
  explicit PixelMotion(const PixelMotionParams& params) : params_(params) {}

  /// Restarts at a position, with zero velocity and a large variance.
  void start(Pixel position, Timestamp time);
  /// Takes a measured position. Times must not go backwards.
  void measure(Pixel position, Timestamp time, const std::optional<PixelVariance>& variance = {});
  /// Predicted position at `time`.
  Pixel expected_at(Timestamp time) const;

  Pixel position() const { return {x_.position, y_.position}; }
  PixelVelocity velocity() const { return {x_.velocity, y_.velocity}; }
  /// Covariance of (x, y, vx, vy), row by row; px², px²/s, px²/s². As of the last measurement.
  std::array<double, 16> covariance() const;

 private:
  struct Axis {
    double position = 0;
    double velocity = 0;
    // Variance of the position, covariance with the velocity, variance of the velocity.
    double pp = 0;
    double pv = 0;
    double vv = 0;

    void predict(double dt, double acceleration_density);
    void correct(double measured, double variance);
    void learn_anew(double measured, double variance);
  };

  PixelMotionParams params_;
  Timestamp time_;
  Axis x_;
  Axis y_;
};

}  // namespace puck
