#pragma once

#include <algorithm>
#include <cmath>

#include "common/vision/puck_size_model.h"

namespace puck {

/// How the events of the puck's contour lie to the ellipse that the size model gives: what
/// `puck-calibrate lag` fits to a recording with truth. The defaults suit a sensor in good light
/// and a puck whose side wall makes events, too.
struct ContourCalibration {
  /// Events appear where the contour was so long ago, µs.
  double lag_us = 300;
  /// The ring of events is lower than the annotated height by this share of the width, and its
  /// centre lies half of that above the annotated one: 0 where the side wall below the puck's top
  /// makes events, the wall's visible height over the width where it makes none. Below 0 the ring
  /// is drawn out downwards: the annotations leave the wall out.
  double wall_share = 0;
  /// By how much the ring's full axes exceed the annotated ones, px.
  double grow_px = 0.5;
  /// How far behind the contour its events lie besides, at any speed, px: a pixel fires only once
  /// the edge has covered some of it, more of it where the contrast is low.
  double trail_px = 0.1;
  /// By how much the ellipse's longer axis is turned from the image's x axis towards its y axis,
  /// within its annotated box, degrees, −40 to 40: 0 for a puck on a table before an upright
  /// camera. What the box cannot hold is cut off.
  double lean_deg = 0;

  /// What `wall_share` would be if the wall made events where it is said not to, or the other way
  /// round. Where the annotations leave the wall out, its events lie below what they outline: those
  /// of an ordinary puck's.
  double other_wall_share(const PuckSizeModel& sizes) const {
    const double wall_of_width = sizes.wall_of_width();
    const double wall = wall_of_width > 0 ? wall_of_width : -sizes.ordinary_wall();
    return std::abs(wall_share) > std::abs(wall) / 2 ? 0 : wall;
  }

  /// How far behind the contour an event is to be expected, px: inside where the contour moves
  /// outwards with this speed along its normal, outside where the speed is negative.
  constexpr double behind_px(double normal_speed_px_s) const {
    // A contour that hardly moves has no behind.
    constexpr double kSlowPx_s = 40;
    const double direction = std::clamp(normal_speed_px_s / kSlowPx_s, -1.0, 1.0);
    return 1e-6 * lag_us * normal_speed_px_s + trail_px * direction;
  }
};

}  // namespace puck
