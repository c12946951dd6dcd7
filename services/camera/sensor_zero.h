#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "common/events/timestamp.h"

namespace puck {

/// When a live sensor's time was 0, on the host's clock: the earliest that any of its packets can
/// have been in the last 10 to 20 s, so that the delays of single packets do not count, while a
/// drift between the clocks is followed.
class SensorZero {
 public:
  /// An event of sensor time `newest` came at host time `utime`, µs.
  void add(Timestamp newest, std::int64_t utime) {
    if (utime - window_began_utime_ > kWindowUs) {
      before_ = current_;
      current_ = kNone;
      window_began_utime_ = utime;
    }
    current_ = std::min(current_, utime - newest.us);
  }

  /// Host CLOCK_REALTIME, µs. At least one event must have come.
  std::int64_t utime() const { return std::min(before_, current_); }

 private:
  static constexpr std::int64_t kWindowUs = 10'000'000;
  static constexpr std::int64_t kNone = std::numeric_limits<std::int64_t>::max();

  std::int64_t before_ = kNone;
  std::int64_t current_ = kNone;
  std::int64_t window_began_utime_ = 0;
};

}  // namespace puck
