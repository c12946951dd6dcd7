#pragma once

#include "common/vision/geometry/pixel.h"

namespace puck {

/// Start of a baseline: the place where PUCK detected the puck, and the puck's size there.
struct PuckSeed {
  Pixel position;
  PuckSize size;
};

}  // namespace puck
