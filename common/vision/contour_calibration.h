#pragma once

namespace puck {

/// How the events of the puck's contour lie to the ellipse that the size model gives: what
/// `puck-calibrate lag` fits to a recording with truth. The defaults suit a sensor in good light and
/// a puck whose side wall makes events, too.
struct ContourCalibration {
  /// Events appear where the contour was so long ago, µs.
  double lag_us = 300;
  /// The ring of events is lower than the annotated height by this share of the width, and its
  /// centre lies half of that above the annotated one: 0 where the side wall below the puck's top
  /// makes events, the wall's visible height over the width where it makes none.
  double wall_share = 0;
  /// By how much the ring's full axes exceed the annotated ones, px.
  double grow_px = 0.5;
};

}  // namespace puck
