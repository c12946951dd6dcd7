#pragma once

#include "common/vision/pixel.h"

namespace puck {

/// What a baseline starts from: where PUCK detected the puck, and how large it must be there.
struct PuckSeed {
  Pixel position;
  PuckSize size;
};

}  // namespace puck
