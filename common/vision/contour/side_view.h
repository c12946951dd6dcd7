#pragma once

#include "common/events/sensor_size.h"
#include "common/vision/contour/puck_contour.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// How much larger, px all round, the ring of a puck at `centre` may be than the size model says.
/// At the left and right sides of the image the head has turned away for the puck to be seen there,
/// so that the table lies at another slant than it was calibrated at. At the angle θ beside the
/// optical axis, the head turned away by ψ, widths are cos²(θ − ψ) / cos² θ times as large, less
/// than 1 + 2 ψ tan θ: a tenth more at the side of a lens that sees 23° to each side, the head
/// turned by 8°.
double side_slack_px(const ContourRing& ring, Pixel centre, SensorSize sensor);

}  // namespace puck
