#pragma once

#include "common/events/sensor_size.h"
#include "common/vision/pixel.h"
#include "common/vision/puck_contour.h"

namespace puck {

/// What is different about a puck at the image's sides. Part of its ring may lie outside. And its
/// size is known less well: where the head has to turn for a puck to be seen there, the table lies
/// at another slant than it was calibrated at. For a puck at the angle θ beside the optical axis,
/// the head turned by ψ, widths are cos²(θ − ψ) / cos² θ times as large, about 1 + 2 ψ tan θ.
struct SideView {
  /// The ring may be so much larger, or smaller, all round than the size model says, px.
  double slack_px = 0;
  /// Of the kContourSectors directions from its centre those in which it lies in the image; at
  /// least half of them, so that a corner of a ring is not taken for a ring.
  int sectors = kContourSectors;
};

/// Of the ring of a puck at `centre`.
SideView side_view_of(const ContourRing& ring, Pixel centre, SensorSize sensor);

}  // namespace puck
