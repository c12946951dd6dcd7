#pragma once

#include <array>
#include <cstdint>

#include "common/vision/geometry/pixel.h"

namespace puck {

struct ContourFilterParams {
  /// Spectral density of the puck's acceleration, px²/s³. Larger follows hits sooner, smaller
  /// smooths more.
  double acceleration_density = 1e6;
  /// Largest speed, px/s: 1.4 times the fastest shot.
  double max_speed_px_s = 12'000;
  /// Time constant, s, with which the size's offset returns to 0, and its spread, px.
  double growth_time_s = 0.5;
  double growth_sigma_px = 0.3;
  double smallest_growth_px = -1.5;
  double largest_growth_px = 0.8;
  /// Variance of an event's distance from the contour, px².
  double event_variance_px2 = 4;
};

/// A Kalman filter on the puck's contour. Its state is the position and velocity in the image and
/// the offset of the contour's size. Each event measures how far the contour must move along its
/// normal, so motion is compensated event by event and many events give a sub-pixel position.
class ContourFilter {
 public:
  struct Start {
    Pixel position;
    PixelVelocity velocity;
    double sigma_px = 2.5;
    double sigma_px_s = 900;
    double growth_px = 0;
    double growth_variance_px2 = 0.09;
  };

  ContourFilter(const ContourFilterParams& params, const Start& start, std::int64_t time_us);

  /// A start at rest at a place, for a puck of the size that this filter has estimated.
  Start start_at(Pixel position) const;

  /// Predicts to `time_us`, not before the last time, with this time constant of the speed.
  void predict(std::int64_t time_us, double damping_s);

  /// For the last `seconds`, the puck moved at only `share`, 0 to 1, of the filter's velocity:
  /// scales the velocity and its errors, moves the position back by the rest of the way at the
  /// present velocity, and takes back what the errors have added to the position's variances since
  /// they were `variances`, px².
  void slow_down(double share, double seconds, const std::array<double, 2>& variances);
  /// Variances of x and y, px².
  std::array<double, 2> place_variances() const { return {cov(0, 0), cov(1, 1)}; }

  /// Variance of the predicted distance of a contour event with this outward normal, px².
  double distance_variance(double normal_x, double normal_y) const;
  /// Variance of the velocity along a normal, px²/s².
  double speed_variance(double normal_x, double normal_y) const;

  /// Allows the contour to be larger than the parameters say by so many px from now on.
  void give_slack(double px);
  double slack_px() const { return slack_px_; }

  /// Corrects with an event `distance_px` outside the predicted contour, which is of the contour
  /// with probability `share`. predict() must have been called for the event's time.
  void correct(double distance_px, double normal_x, double normal_y, double share = 1);

  std::int64_t time_us() const { return time_us_; }
  Pixel position() const { return {state_[0], state_[1]}; }
  /// Position at an earlier time, at the present velocity; position() for later times.
  Pixel position_at(std::int64_t time_us) const;
  PixelVelocity velocity() const { return {state_[2], state_[3]}; }
  double growth_px() const { return state_[4]; }
  double speed_px_s() const;
  /// Of (x, y, vx, vy), row by row.
  std::array<double, 16> covariance() const;

 private:
  static constexpr std::size_t kSize = 5;
  using State = std::array<double, kSize>;

  void scale(std::size_t component, double factor);
  void keep_in_bounds();
  double& cov(std::size_t row, std::size_t column) { return covariance_[row * kSize + column]; }
  double cov(std::size_t row, std::size_t column) const {
    return covariance_[row * kSize + column];
  }

  ContourFilterParams params_;
  std::int64_t time_us_ = 0;
  double slack_px_ = 0;
  State state_{};
  std::array<double, kSize * kSize> covariance_{};
};

}  // namespace puck
