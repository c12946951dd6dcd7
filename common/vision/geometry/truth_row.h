#pragma once

#include "common/events/timestamp.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// True place of the puck at one time, on its recording's own clock.
struct TruthRow {
  Timestamp time;
  Pixel centre;
  PuckSize size;
  double visible = 1;  ///< Visible fraction of the puck, 0 to 1.
};

}  // namespace puck
