#pragma once

#include "common/events/sensor_size.h"
#include "common/vision/pixel.h"
#include "common/vision/puck_contour.h"

namespace puck {

/// What is different about a puck at the left and right sides of the image. Part of its ring may
/// lie outside. And it may be larger than the size model says: the head has turned away for it to
/// be seen there, so that the table lies at another slant than it was calibrated at. At the angle θ
/// beside the optical axis, the head turned away by ψ, widths are cos²(θ − ψ) / cos² θ times as
/// large, less than 1 + 2 ψ tan θ: a tenth more at the side of a lens that sees 23° to each side,
/// the head turned by 8°.
struct SideView {
  /// The ring may be so much larger all round, px.
  double slack_px = 0;
  /// Of the kContourSectors directions from its centre those in which it does not lie beyond either
  /// side; at least half of them, so that a corner of a ring is not taken for a ring.
  int sectors = kContourSectors;
};

/// Whether a place is at one of the sides.
bool is_aside(Pixel place, SensorSize sensor);

/// Of the ring of a puck at `centre`.
SideView side_view_of(const ContourRing& ring, Pixel centre, SensorSize sensor);

}  // namespace puck
