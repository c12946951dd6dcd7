#pragma once

#include <compare>
#include <cstdint>

namespace puck {

/// A point in sensor time: microseconds since the sensor's start. Wall-clock time is never a
/// Timestamp. Differences are plain microseconds, in variables that end in `_us`.
struct Timestamp {
  std::int64_t us = 0;

  friend constexpr auto operator<=>(Timestamp, Timestamp) = default;
  friend constexpr std::int64_t operator-(Timestamp later, Timestamp earlier) {
    return later.us - earlier.us;
  }
  friend constexpr Timestamp operator+(Timestamp time, std::int64_t offset_us) {
    return {time.us + offset_us};
  }
  friend constexpr Timestamp operator-(Timestamp time, std::int64_t offset_us) {
    return {time.us - offset_us};
  }
};

/// Whether the time is possible: no sensor runs for longer than 30 years.
constexpr bool is_sensor_time(Timestamp time) {
  constexpr std::int64_t kLongestRunUs = 1'000'000'000'000'000;
  return time.us >= 0 && time.us <= kLongestRunUs;
}

}  // namespace puck
