#pragma once

#include "common/events/sensor_size.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// Mirrors a picture, then rotates it clockwise by quarter turns.
struct PictureTurn {
  bool flip_x = false;  ///< Left becomes right.
  bool flip_y = false;  ///< Top becomes bottom.
  int rotate_deg = 0;   ///< 0, 90, 180 or 270.

  friend constexpr bool operator==(const PictureTurn&, const PictureTurn&) = default;

  constexpr bool is_none() const { return *this == PictureTurn{}; }
  constexpr bool swaps_axes() const { return rotate_deg % 180 != 0; }

  constexpr SensorSize size_of(SensorSize picture) const {
    return swaps_axes() ? SensorSize{picture.height, picture.width} : picture;
  }

  /// Where the point `at` of a picture of this size is after the turn.
  constexpr Pixel apply(Pixel at, SensorSize picture) const {
    const double right = picture.width - 1;
    const double bottom = picture.height - 1;
    const Pixel flipped{flip_x ? right - at.x : at.x, flip_y ? bottom - at.y : at.y};
    switch (rotate_deg) {
      case 90:
        return {bottom - flipped.y, flipped.x};
      case 180:
        return {right - flipped.x, bottom - flipped.y};
      case 270:
        return {flipped.y, right - flipped.x};
      default:
        return flipped;
    }
  }
};

}  // namespace puck
