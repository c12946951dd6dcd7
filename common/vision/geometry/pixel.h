#pragma once

#include <cmath>

namespace puck {

/// A place in the image, px: x right, y down, pixel centres at integers.
struct Pixel {
  double x = 0;
  double y = 0;

  friend constexpr bool operator==(Pixel, Pixel) = default;
};

inline double distance_px(Pixel a, Pixel b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y));
}

/// A velocity in the image, px/s.
struct PixelVelocity {
  double x = 0;
  double y = 0;
};

/// Full axes of the puck's upright ellipse in the image, px.
struct PuckSize {
  double width = 0;
  double height = 0;
};

}  // namespace puck
