#pragma once

#include "common/events/timestamp.h"
#include "common/vision/pixel.h"

namespace puck {

/// Where the puck truly was at one time, on its recording's own clock.
struct TruthRow {
  Timestamp time;
  Pixel centre;
  PuckSize size;
  double visible = 1;  ///< Fraction of the puck that can be seen, 0 to 1.
};

}  // namespace puck
