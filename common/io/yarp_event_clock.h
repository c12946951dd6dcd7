#pragma once

#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"

namespace puck {

/// Sensor time, µs since the first event, from an IIT camera's stamps: a 31-bit counter that wraps.
/// The host's time of each packet gives the number of wraps in a long pause, and identifies
/// doubtful stamps: those more than a second ahead of the host's clock, or more than a second back.
/// Many doubtful stamps in a row mean that the counter was reset; time then continues from its last
/// value.
class YarpEventClock {
 public:
  explicit YarpEventClock(double us_per_tick) : us_per_tick_(us_per_tick) {}

  /// The time of an event with `stamp` in a packet sent at `host_s`; it may lie up to a second
  /// before that of an earlier event. `std::nullopt` for a doubtful stamp.
  std::optional<Timestamp> at(std::uint32_t stamp, double host_s);

 private:
  double us_per_tick_;
  bool is_known_ = false;
  std::int64_t ticks_ = 0;   // From the first event to the newest accepted one.
  std::uint32_t stamp_ = 0;  // Of the newest accepted event.
  double host_s_ = 0;        // Sending time of its packet.
  int doubtful_in_succession_ = 0;
};

}  // namespace puck
