#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/events/event.h"
#include "common/events/timestamp.h"

namespace puck {

/// A bounded queue for single events from the event thread to the stepping thread (see
/// SharedSurface), in order. It neither grows nor blocks. Above half full it thins the events: each
/// time the free space halves, half as many events are accepted, so that a slow tracking thread
/// gets a thinner stream without gaps.
class EventQueue {
 public:
  /// Rounds the capacity up to a power of two. Throws std::invalid_argument when it is less than
  /// two.
  explicit EventQueue(std::size_t capacity);

  /// Event thread only. Accepts the events, thinned as space requires. Times must not decrease.
  void push(Timestamp start, std::span<const Event> events);

  /// Safe from any thread. Number of events accepted so far: a position in the stream.
  std::uint64_t end() const { return end_.load(std::memory_order_acquire); }

  /// Stepping thread only. Moves at most `most` of the events before the position `until` to `out`,
  /// in order, with times relative to the returned time. `out` is empty when there is none.
  Timestamp pop(std::uint64_t until, std::size_t most, std::vector<Event>& out);

  /// Safe from any thread. Number of events that thinning dropped.
  std::int64_t thinned() const { return thinned_.load(std::memory_order_relaxed); }

 private:
  struct Slot {
    std::int64_t time_us = 0;
    Event event;
  };

  Slot& slot(std::uint64_t position) { return slots_[position & (slots_.size() - 1)]; }
  std::size_t stride_for(std::size_t space) const;

  std::vector<Slot> slots_;  // The size is a power of two.
  std::size_t skipped_ = 0;  // Event thread. Events dropped since the last accepted one.

  // Positions in the stream. Each is written by one thread at a time, which loads its own one
  // relaxed. end_: released after the slots before it are written, acquired before they are read.
  // begin_: released after the slots before it are read, acquired before they are written again.
  std::atomic<std::uint64_t> end_{0};
  std::atomic<std::uint64_t> begin_{0};
  // Relaxed: no other data depends on it.
  std::atomic<std::int64_t> thinned_{0};
};

}  // namespace puck
