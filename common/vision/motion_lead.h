#pragma once

#include "common/vision/pixel.h"

namespace puck {

/// By how much the surface shows the puck behind where it is, beyond the sensor's own lag.
struct MotionLeadParams {
  /// Off: positions are where the surface shows the puck.
  bool enabled = false;
  /// A contour pixel stays bright until its neighbours have fired in turn, which takes some way
  /// rather than some time, px …
  double edge_px = 0.27;
  /// … for a puck faster than this, px/s; nearly none for a slower one.
  double slow_px_s = 200;
  /// What the last events of an edge that passes lag behind its first ones, µs.
  double edge_us = 130;
};

/// Moves a position forward to where the puck is by now. `lag_us`: the sensor's.
Pixel led(Pixel position, PixelVelocity velocity, double lag_us, const MotionLeadParams& params);

}  // namespace puck
