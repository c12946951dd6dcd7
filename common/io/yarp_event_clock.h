#pragma once

#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"

namespace puck {

/// Sensor time, µs since the first event, of an IIT camera's stamps: a counter of 31 bits that
/// wraps. The host's time of each packet tells how often it wrapped in a long pause, and which
/// stamps are doubtful: those that are more than a second ahead of what the host's clock allows, or
/// more than a second back. Only where many doubtful stamps follow one another was the counter set
/// anew; time then goes on from where it was.
class YarpEventClock {
 public:
  explicit YarpEventClock(double us_per_tick) : us_per_tick_(us_per_tick) {}

  /// The time of an event with `stamp` in a packet sent at `host_s`; it may lie up to a second
  /// before that of an earlier event. Nothing for a doubtful stamp.
  std::optional<Timestamp> at(std::uint32_t stamp, double host_s);

 private:
  double us_per_tick_;
  bool is_known_ = false;
  std::int64_t ticks_ = 0;   // From the first event to the newest one that was believed.
  std::uint32_t stamp_ = 0;  // Of that one …
  double host_s_ = 0;        // … and when its packet was sent.
  int doubtful_in_succession_ = 0;
};

}  // namespace puck
