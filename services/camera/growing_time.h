#pragma once

#include <cstdint>
#include <limits>
#include <utility>

#include "common/events/timestamp.h"
#include "services/camera/event_source.h"

namespace puck {

/// Joins recordings or connections, each with its own clock, to one growing time.
class GrowingTime {
 public:
  /// Later times come from a new clock. If it begins before the newest time so far, it is shifted
  /// to begin `gap_us` after that time.
  void begin_new_clock(std::int64_t gap_us) {
    is_new_ = true;
    gap_us_ = gap_us;
  }

  /// Times of one clock must not go back from call to call.
  Timestamp place(Timestamp time) {
    if (is_new_) {
      is_new_ = false;
      shift_us_ = time < earliest_next() ? earliest_next() - time : 0;
    }
    newest_ = time + shift_us_;
    has_newest_ = true;
    return newest_;
  }

  /// The time on the present clock that was placed at `placed`.
  Timestamp original(Timestamp placed) const { return placed - shift_us_; }

 private:
  Timestamp earliest_next() const {
    return has_newest_ ? newest_ + gap_us_ : Timestamp{std::numeric_limits<std::int64_t>::min()};
  }

  bool is_new_ = true;
  bool has_newest_ = false;
  std::int64_t gap_us_ = 1;
  std::int64_t shift_us_ = 0;
  Timestamp newest_;
};

/// Places the events of a connection's chunk in the growing time. `is_new_clock`: it is the
/// connection's first one; becomes false.
inline void place(EventSource::Chunk& chunk, GrowingTime& time, bool& is_new_clock) {
  const Timestamp newest = chunk.packet.newest();
  chunk.new_clock = std::exchange(is_new_clock, false);
  chunk.packet.start = time.place(chunk.packet.start);
  chunk.until = time.place(newest);
}

}  // namespace puck
