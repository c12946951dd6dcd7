#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "common/events/event.h"
#include "common/events/sensor_size.h"
#include "common/vision/geometry/image.h"
#include "common/vision/geometry/pixel.h"

namespace puck::test {

/// One event at each of `count` places around the contour of a puck, in scattered order.
inline std::vector<Event> contour_events(SensorSize sensor, Pixel centre, PuckSize size,
                                         int count) {
  std::vector<Event> events;
  for (int i = 0; i < count; ++i) {
    // Steps of the golden angle spread any number of places evenly.
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const long x = std::lround(centre.x + size.width / 2 * std::cos(angle));
    const long y = std::lround(centre.y + size.height / 2 * std::sin(angle));
    if (!sensor.contains(static_cast<int>(x), static_cast<int>(y))) continue;
    events.push_back({static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y), 1, 0});
  }
  return events;
}

}  // namespace puck::test
