#pragma once

#include "common/events/timestamp.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// A mark of the puck in a recording, made by a person or by the simulator.
struct Annotation {
  Timestamp time;
  Pixel centre;
  PuckSize size;
};

}  // namespace puck
