#pragma once

#include <array>

#include "common/vision/pixel.h"

namespace puck {

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
                         const std::array<double, 16>& covariance, double lag_us,
                         double trail, const MotionLeadParams& params);

}  // namespace puck
