#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/events/event.h"
#include "common/events/timestamp.h"
#include "common/vision/region.h"

namespace puck {

/// Single events on their way from the event thread to whoever makes the step (see SharedSurface),
/// in order. It never grows and nobody ever waits: half of it is filled as events come; from there
/// on, each time that the room left has halved, only half as many get in, so that a tracking thread
/// that falls behind gets a thinner stream of events, not a torn one.
class EventQueue {
 public:
  /// The capacity is rounded up to a power of two. Throws std::invalid_argument when it is less
  /// than two.
  explicit EventQueue(std::size_t capacity);

  /// Event thread only. Takes the events inside `region`, as many as there is room for; returns how
  /// many lie inside. Times must not go backwards.
  std::size_t push(Timestamp start, std::span<const Event> events, const Region& region);

  /// Safe from any thread. How many events have ever been let in: a position in the stream.
  std::uint64_t end() const { return end_.load(std::memory_order_acquire); }

  /// By whoever makes the step. Takes at most `most` of the events before the position `until`, in
  /// order; `out` is replaced by them, with times relative to what is returned. No event in `out`:
  /// there is none left.
  Timestamp pop(std::uint64_t until, std::size_t most, std::vector<Event>& out);

  /// Safe from any thread. How many events were kept out.
  std::int64_t thinned() const { return thinned_.load(std::memory_order_relaxed); }

 private:
  struct Slot {
    std::int64_t time_us = 0;
    Event event;
  };

  Slot& slot(std::uint64_t position) { return slots_[position & (slots_.size() - 1)]; }
  std::size_t one_event_in(std::size_t room) const;

  std::vector<Slot> slots_;  // a power of two of them
  std::size_t skipped_ = 0;  // events kept out since the last one let in; event thread

  // Positions in the stream. Each is written by one thread at a time, which reads its own one
  // relaxed. end_: released after the slots before it are written, acquired before they are read.
  // begin_: released after the slots before it are read, acquired before they are written again.
  std::atomic<std::uint64_t> end_{0};
  std::atomic<std::uint64_t> begin_{0};
  // Relaxed: a number that stands alone.
  std::atomic<std::int64_t> thinned_{0};
};

}  // namespace puck
