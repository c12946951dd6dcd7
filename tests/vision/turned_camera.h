#pragma once

#include "common/vision/geometry/pixel.h"

namespace puck::test {

/// Of a camera that turns: its principal point, and its focal length.
inline constexpr Pixel kMiddle{320, 240};
inline constexpr double kFocal_px = 700;

}  // namespace puck::test
