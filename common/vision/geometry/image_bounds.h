#pragma once

#include <algorithm>

#include "common/events/sensor_size.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// The nearest place in the image.
inline Pixel nearest_in_image(Pixel place, SensorSize sensor) {
  return {std::clamp(place.x, 0.0, sensor.width - 1.0),
          std::clamp(place.y, 0.0, sensor.height - 1.0)};
}

/// Whether a place lies in the image, which ends at the centres of its outermost pixels.
inline bool is_in_image(Pixel place, SensorSize sensor) {
  return nearest_in_image(place, sensor) == place;
}

}  // namespace puck
