#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"

namespace puck {

/// The newest event of each pixel: what a picture of any time window needs, in memory and drawing
/// time that do not depend on the rate of events. One thread at a time; copies are independent.
class NewestEvents {
 public:
  /// Forgets all events.
  void reset(SensorSize sensor) {
    sensor_ = sensor;
    stamps_.assign(static_cast<std::size_t>(sensor.width) * static_cast<std::size_t>(sensor.height),
                   kNone);
  }

  /// Events outside the sensor are ignored.
  void update(const EventPacket& packet) {
    for (const Event& event : packet.events) {
      if (!sensor_.contains(event.x, event.y)) continue;
      stamps_[index_of(event.x, event.y)] = packet.time_of(event).us * 2 + event.polarity;
    }
  }

  SensorSize sensor() const { return sensor_; }

  /// Row of stamps: 2 · time (µs) + polarity (1: brighter), or kNone.
  const std::int64_t* row(int y) const { return stamps_.data() + index_of(0, y); }
  static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::min();

  static constexpr Timestamp time_of(std::int64_t stamp) { return {stamp >> 1}; }
  static constexpr bool is_brighter(std::int64_t stamp) { return (stamp & 1) != 0; }

 private:
  std::size_t index_of(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(sensor_.width) +
           static_cast<std::size_t>(x);
  }

  SensorSize sensor_;
  std::vector<std::int64_t> stamps_;
};

}  // namespace puck
