#pragma once

#include <array>
#include <cstdint>

#include "common/events/timestamp.h"
#include "common/vision/pixel.h"

namespace puck {

struct ContourFilterParams {
  /// Spectral density of the puck's acceleration, px²/s³. Larger follows hits sooner, smaller
  /// smooths more.
  double acceleration_density = 1e6;
  /// Time constant of the puck's speed, s, and the same while nothing supports the track.
  double damping_s = 1;
  double blind_damping_s = 0.06;
  /// Largest speed, px/s: 1.4 times the fastest shot.
  double max_speed_px_s = 12'000;
  /// Time constant, s, with which the size's offset returns to 0, and its spread, px.
  double growth_time_s = 0.5;
  double growth_sigma_px = 0.3;
  double smallest_growth_px = -1.5;
  double largest_growth_px = 0.8;
  /// Variance of an event's distance from the contour, px².
  double event_variance_px2 = 4;
  bool follows_size = true;
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

  /// Predicts to `time_us`, not before the last time; `blind`: no recent event supports the track.
  void predict(std::int64_t time_us, bool blind) {
    predict(time_us, blind ? params_.blind_damping_s : params_.damping_s);
  }
  /// The same with a time constant of the speed.
  void predict(std::int64_t time_us, double damping_s);

  /// The puck was slower than the filter takes it to be, by `share`: shrinks the velocity and its
  /// errors, and takes back what those have added to the position's variances since they were
  /// `variances`.
  void slow_down(double share, const std::array<double, 2>& variances);
  /// Variances of x and y, px².
  std::array<double, 2> place_variances() const { return {cov(0, 0), cov(1, 1)}; }

  /// Variance of the predicted distance of a contour event with this outward normal, px².
  double distance_variance(double normal_x, double normal_y) const;
  /// Variance of the velocity along a normal, px²/s².
  double speed_variance(double normal_x, double normal_y) const;

  /// Allows the contour to be larger than the parameters say by so many px from now on.
  void give_slack(double px);
  double slack_px() const { return slack_px_; }
  double largest_growth_px() const { return params_.largest_growth_px + slack_px_; }

  /// Corrects with an event `distance_px` outside the predicted contour, which is of the contour
  /// with probability `share`. predict() must have been called for the event's time.
  void correct(double distance_px, double normal_x, double normal_y, double share = 1);

  /// Corrects with an independent position measurement, (dx, dy) from the filter's position, with
  /// standard deviation `sigma_px` along each axis.
  void correct_place(double dx, double dy, double sigma_px);

  /// Sets the velocity to 0 and bounds the standard deviations.
  void park(double sigma_px, double sigma_px_s);

  /// Sets position and velocity, and bounds the standard deviations.
  void carry(Pixel position, PixelVelocity velocity, double sigma_px, double sigma_px_s);

  /// Restarts at rest at a place, with the uncertainty of a start.
  void restart(const Start& start);

  std::int64_t time_us() const { return time_us_; }
  Pixel position() const { return {state_[0], state_[1]}; }
  /// Position at an earlier time, at the present velocity; position() for later times.
  Pixel position_at(std::int64_t time_us) const;
  PixelVelocity velocity() const { return {state_[2], state_[3]}; }
  double growth_px() const { return state_[4]; }
  double speed_px_s() const;
  /// Ratio of the velocity's standard deviation along its direction to that across, 1 at rest.
  /// Large between two parallel edges, which do not measure motion along themselves.
  double slide() const;
  /// Of (x, y, vx, vy), row by row.
  std::array<double, 16> covariance() const;

 private:
  static constexpr std::size_t kSize = 5;
  using State = std::array<double, kSize>;

  /// The Kalman step for one scalar measurement: `ph` is the state's covariance with it,
  /// `per_innovation` the inverse of the innovation's variance.
  void apply(const State& ph, double per_innovation, double innovation);
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
