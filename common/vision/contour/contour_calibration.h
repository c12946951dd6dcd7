#pragma once

#include <algorithm>
#include <cmath>

#include "common/vision/geometry/puck_size_model.h"

namespace puck {

/// Position of the puck's contour events relative to the ellipse of the size model. `puck-calibrate
/// lag` fits it to a recording with truth. The defaults suit a sensor in good light and a puck
/// whose side wall makes events, too.
struct ContourCalibration {
  /// Delay between the change of light and the event's time stamp, µs.
  double lag_us = 300;
  /// Height that the ring of events lacks, as a share of the annotated width; its centre lies half
  /// of that above the annotated one. 0 where the side wall below the puck's top makes events; the
  /// wall's visible height over the width where it makes none; below 0 where the annotations leave
  /// the wall out, so that the ring reaches farther down.
  double wall_share = 0;
  /// Excess of the ring's full axes over the annotated ones, px.
  double grow_px = 0.5;
  /// Further distance of the events behind the contour, px, the same at any speed: a pixel fires
  /// only once the edge has covered some of it, more of it where the contrast is low.
  double trail_px = 0.1;
  /// Rotation of the ellipse's longer axis from the image's x axis towards its y axis, degrees, −40
  /// to 40: 0 for a puck on a table before an upright camera. The ellipse stays within its
  /// annotated box.
  double lean_deg = 0;

  /// The `wall_share` of the opposite assumption on whether the wall makes events. Where the
  /// annotations leave the wall out, its height is that of an ordinary puck's wall.
  double other_wall_share(const PuckSizeModel& sizes) const {
    const double wall_of_width = sizes.wall_of_width();
    const double wall = wall_of_width > 0 ? wall_of_width : -sizes.ordinary_wall();
    return std::abs(wall_share) > std::abs(wall) / 2 ? 0 : wall;
  }

  /// Expected distance of an event behind the contour, px: inside where the contour moves outwards
  /// at this speed along its normal, outside where the speed is negative.
  constexpr double behind_px(double normal_speed_px_s) const {
    // Continuous through 0: a contour at rest has no trailing side.
    constexpr double kSlowPx_s = 40;
    const double direction = std::clamp(normal_speed_px_s / kSlowPx_s, -1.0, 1.0);
    return 1e-6 * lag_us * normal_speed_px_s + trail_px * direction;
  }
};

}  // namespace puck
