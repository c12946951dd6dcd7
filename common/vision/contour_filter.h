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
  /// The puck slows down with this time constant, s; sooner while nothing supports the track.
  double damping_s = 1;
  double blind_damping_s = 0.06;
  /// No puck is faster, px/s: 1.4 times the fastest shot.
  double max_speed_px_s = 12'000;
  /// The size's offset wanders back to 0 with this time constant, s, and this spread, px.
  double growth_time_s = 0.5;
  double growth_sigma_px = 0.3;
  double smallest_growth_px = -1.5;
  double largest_growth_px = 0.8;
  /// Variance of an event's distance from the contour, px².
  double event_variance_px2 = 4;
  bool follows_size = true;
};

/// A Kalman filter on the puck's contour: position and velocity in the image and the offset of the
/// contour's size, corrected by single events, each of which says how far along its normal the
/// contour must move. So motion is compensated event by event, and the position is as fine as many
/// events make it.
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

  /// A start at rest at a place, for a puck of the size that this filter has found.
  Start start_at(Pixel position) const;

  /// Moves on to `time_us`, not before the last; `blind`: nothing has supported the track of late.
  void predict(std::int64_t time_us, bool blind);

  /// Variance of the predicted distance of a contour event with this outward normal, px².
  double distance_variance(double normal_x, double normal_y) const;
  /// Variance of the velocity along a normal, px²/s².
  double speed_variance(double normal_x, double normal_y) const;

  /// The contour may be larger than the parameters say by so much, px, from now on.
  void give_slack(double px);
  double slack_px() const { return slack_px_; }
  double largest_growth_px() const { return params_.largest_growth_px + slack_px_; }

  /// Takes an event that lies `distance_px` outside the predicted contour. The filter must have
  /// been predicted to the event's time.
  void correct(double distance_px, double normal_x, double normal_y);

  /// Takes that something else saw the puck so far from where the filter has it, as well as
  /// `sigma_px` along each axis.
  void correct_place(double dx, double dy, double sigma_px);

  /// Takes its velocity, and keeps the uncertainty below these bounds.
  void park(double sigma_px, double sigma_px_s);

  /// Takes it to a place with a velocity, and keeps the uncertainty below these bounds.
  void carry(Pixel position, PixelVelocity velocity, double sigma_px, double sigma_px_s);

  /// Puts the puck to rest at a place, with the uncertainty of a start.
  void restart(const Start& start);

  std::int64_t time_us() const { return time_us_; }
  Pixel position() const { return {state_[0], state_[1]}; }
  /// Where it was at an earlier time, had it moved as it does now; at later ones: position().
  Pixel position_at(std::int64_t time_us) const;
  PixelVelocity velocity() const { return {state_[2], state_[3]}; }
  double growth_px() const { return state_[4]; }
  double speed_px_s() const;
  /// How much less is known of the velocity along itself than across: the ratio of the standard
  /// deviations, 1 at rest. Two parallel edges tell nothing of a motion along them.
  double slide() const;
  /// Of (x, y, vx, vy), row by row.
  std::array<double, 16> covariance() const;

 private:
  static constexpr std::size_t kSize = 5;
  using State = std::array<double, kSize>;

  /// The Kalman step for one measured number: `ph` is the covariance of the state with it,
  /// `per_innovation` the inverse of its variance.
  void apply(const State& ph, double per_innovation, double innovation);
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
