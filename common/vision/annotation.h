#pragma once

#include "common/events/timestamp.h"
#include "common/vision/pixel.h"

namespace puck {

/// A puck as a person, or the simulator in a person's place, marked it in a recording.
struct Annotation {
  Timestamp time;
  Pixel centre;
  PuckSize size;
};

}  // namespace puck
