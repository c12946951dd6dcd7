#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "common/events/timestamp.h"

namespace puck {

/// Host time at sensor time 0 of a live sensor: the minimum over the packets of the last 10 to 20
/// s, so that delays of single packets have no effect and a drift between the clocks is followed.
class SensorZero {
 public:
  /// An event of sensor time `newest` was received at host time `utime`, µs.
  void add(Timestamp newest, std::int64_t utime) {
    if (utime - window_began_utime_ > kWindowUs) {
      before_ = current_;
      current_ = kNone;
      window_began_utime_ = utime;
    }
    current_ = std::min(current_, utime - newest.us);
  }

  /// Host CLOCK_REALTIME, µs. Requires at least one event.
  std::int64_t utime() const { return std::min(before_, current_); }

 private:
  static constexpr std::int64_t kWindowUs = 10'000'000;
  static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();

  std::int64_t before_ = kNone;
  std::int64_t current_ = kNone;
  std::int64_t window_began_utime_ = 0;
};

}  // namespace puck
