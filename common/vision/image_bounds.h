#pragma once

#include <algorithm>

#include "common/events/sensor_size.h"
#include "common/vision/pixel.h"

namespace puck {

/// The nearest place in the image, or at most `beyond_px` outside it.
inline Pixel nearest_in_image(Pixel place, SensorSize sensor, double beyond_px = 0) {
  return {std::clamp(place.x, -beyond_px, sensor.width - 1 + beyond_px),
          std::clamp(place.y, -beyond_px, sensor.height - 1 + beyond_px)};
}

/// Whether a place lies in the image, which ends at the centres of its outermost pixels.
inline bool is_in_image(Pixel place, SensorSize sensor) {
  return nearest_in_image(place, sensor) == place;
}

}  // namespace puck
