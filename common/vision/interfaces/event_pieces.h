#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "common/events/event.h"
#include "common/events/timestamp.h"

namespace puck {

/// Cuts events into pieces at the multiples of a period of sensor time and hands each to
/// `on_piece(std::span<const Event>)`. An event at such a time is the last of its piece, as it is
/// part of what an estimate for that time rests on. Period 0: all in one piece. The events must be
/// in the order of their times, which must not be negative.
template <typename OnPiece>
void for_each_piece(Timestamp start, std::span<const Event> events, std::int64_t period_us,
                    const OnPiece& on_piece) {
  while (!events.empty()) {
    std::size_t count = events.size();
    if (period_us > 0) {
      const Timestamp first = start + events.front().offset_us;
      const Timestamp end{(first.us + period_us - 1) / period_us * period_us};
      const auto beyond = std::upper_bound(
          events.begin(), events.end(), end,
          [&](Timestamp time, const Event& event) { return time < start + event.offset_us; });
      count = static_cast<std::size_t>(beyond - events.begin());
    }
    on_piece(events.first(count));
    events = events.subspan(count);
  }
}

}  // namespace puck
