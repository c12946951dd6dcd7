#pragma once

#include <algorithm>
#include <cmath>

#include "common/events/sensor_size.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// A rectangle of pixels: columns x to x + width − 1, rows y to y + height − 1.
struct Region {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;

  friend constexpr bool operator==(const Region&, const Region&) = default;

  static constexpr Region all_of(SensorSize size) { return {0, 0, size.width, size.height}; }

  /// The region of the given size whose middle lies nearest to `centre`.
  static Region around(Pixel centre, int width, int height) {
    return {static_cast<int>(std::lround(centre.x - (width - 1) / 2.0)),
            static_cast<int>(std::lround(centre.y - (height - 1) / 2.0)), width, height};
  }

  constexpr bool empty() const { return width <= 0 || height <= 0; }
  constexpr int right() const { return x + width; }    ///< First column beyond the region.
  constexpr int bottom() const { return y + height; }  ///< First row beyond the region.
  constexpr Pixel centre() const { return {x + (width - 1) / 2.0, y + (height - 1) / 2.0}; }

  constexpr bool contains(int px, int py) const {
    return px >= x && px < right() && py >= y && py < bottom();
  }

  constexpr Region intersect(const Region& other) const {
    const int left = std::max(x, other.x);
    const int top = std::max(y, other.y);
    const int width_left = std::min(right(), other.right()) - left;
    const int height_left = std::min(bottom(), other.bottom()) - top;
    if (width_left <= 0 || height_left <= 0) return {left, top, 0, 0};
    return {left, top, width_left, height_left};
  }

  /// Larger by `margin` pixels on every side.
  constexpr Region inflated(int margin) const {
    return {x - margin, y - margin, width + 2 * margin, height + 2 * margin};
  }
};

}  // namespace puck
