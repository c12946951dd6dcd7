#pragma once

#include <cstdint>
#include <string_view>

#include "common/events/event.h"
#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"

namespace puck {

/// Checks of the events of every writer.

/// Returns `sensor` if it is valid; else throws std::invalid_argument.
SensorSize checked_sensor(SensorSize sensor);

/// Throws std::invalid_argument for an event outside the sensor, or older than `newest`.
void check_event(const Event& event, Timestamp time, SensorSize sensor, Timestamp newest);

/// The sum of a recording's pauses, for formats that fill them. A few damaged times could otherwise
/// fill the disk.
class PauseSum {
 public:
  static constexpr std::int64_t kMostUs = std::int64_t{24} * 3600 * 1'000'000;
  static constexpr std::int64_t kMostUsAnEvent = 100'000;

  /// `pause_us`: before the next event. `format` is in the message. Throws std::invalid_argument
  /// where all pauses are longer than 24 h and 0.1 s an event.
  void add(std::int64_t pause_us, std::string_view format);

 private:
  std::int64_t sum_us_ = 0;
  std::int64_t events_ = 0;
};

}  // namespace puck
