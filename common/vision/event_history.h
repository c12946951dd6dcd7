#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "common/events/event.h"
#include "common/events/sensor_size.h"

namespace puck {

/// Remembers when each pixel last fired with each sign, to tell the first event of an edge's
/// passing from those that follow it.
class EventHistory {
 public:
  explicit EventHistory(SensorSize sensor)
      : width_(sensor.width),
        last_us_(
            2 * static_cast<std::size_t>(sensor.width) * static_cast<std::size_t>(sensor.height),
            std::numeric_limits<std::int64_t>::min() / 2) {}

  /// Takes an event; true when its pixel has not fired with this sign for 3 ms.
  bool is_first(const Event& event, std::int64_t time_us) {
    std::int64_t& last =
        last_us_[2 * (static_cast<std::size_t>(event.y) * static_cast<std::size_t>(width_) +
                      event.x) +
                 event.polarity];
    const bool first = time_us - last > kPassing_us;
    last = time_us;
    return first;
  }

 private:
  static constexpr std::int64_t kPassing_us = 3'000;

  int width_;
  std::vector<std::int64_t> last_us_;  // both signs of a pixel side by side
};

}  // namespace puck
