#pragma once

#include <cstdint>

namespace puck {

/// When the last decision before an event was due. Decisions are made at multiples of the period,
/// and events at such a time belong to the decision at that time. All in µs of sensor time;
/// `event_us` is above 0.
constexpr std::int64_t decision_before(std::int64_t event_us, std::int64_t period_us) {
  return (event_us - 1) / period_us * period_us;
}

}  // namespace puck
