#pragma once

#include <array>

#include "common/events/timestamp.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

struct EdgeTrailParams {
  /// How widely the ring's grey is spread across the contour where pucks make many events a pixel,
  /// clutter included, px …
  double short_px = 0.85;
  /// … and how widely where they make hardly one.
  double long_px = 1.25;
  /// What the sensor's lag, which differs from event to event, adds to that, µs.
  double blur_us = 170;
  /// How long it takes to learn, ms of good track.
  double learning_ms = 200;
};

/// How long a trail the puck's contour draws on the surface, learned while the track is good. A
/// pixel fades with the events of its neighbours, so the contour of a puck of low contrast, which
/// makes hardly one event a pixel, stays on the surface several times as long as that of a dark
/// one, and the ring lies farther behind the puck.
class EdgeTrail {
 public:
  explicit EdgeTrail(const EdgeTrailParams& params) : params_(params) {}

  /// Takes how widely the ring's grey is spread, px, of a puck of that speed.
  void learn(double spread_px, double speed_px_s, Timestamp time);

  /// 0: as short as a dark puck's; 1: as long as that of one of low contrast.
  double length() const { return length_; }

 private:
  EdgeTrailParams params_;
  double length_ = 0;
  Timestamp learned_at_;
};

/// By how much the surface shows the puck behind where it is, beyond the sensor's own lag.
struct MotionLeadParams {
  /// Off: positions are where the surface shows the puck.
  bool enabled = false;
  /// A contour pixel stays bright until its neighbours have fired in turn, which takes some way
  /// rather than some time, px; what single events lie behind at any speed is part of it …
  double edge_px = 0.27;
  /// … for a puck faster than this, px/s; nearly none for a slower one.
  double slow_px_s = 200;
  /// What the last events of an edge that passes lag behind its first ones, µs.
  double edge_us = 130;
  /// How much more of both lags there is at an edge trail of length 1 (EdgeTrail).
  double trail_gain = 2.5;
  /// Standard deviations of the lags from one puck and light to another, px and µs.
  double edge_sigma_px = 0.05;
  double lag_sigma_us = 30;
  /// Standard deviation that a trail of length 1 adds in every direction, px.
  double trail_sigma_px = 0.6;
};

/// A position and its covariance, of (x, y, vx, vy) row by row.
struct LedPosition {
  Pixel position;
  std::array<double, 16> covariance{};
};

/// Moves a position forward to where the puck is by now. `lag_us`: the sensor's. `trail`:
/// EdgeTrail::length. What is not known of velocity and lags goes into the covariance.
LedPosition lead_forward(Pixel position, PixelVelocity velocity,
                         const std::array<double, 16>& covariance, double lag_us, double trail,
                         const MotionLeadParams& params);

}  // namespace puck
