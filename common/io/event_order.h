#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "common/events/event_packet.h"

namespace puck {

/// Puts events in the order of their times that are up to `reorder_us` too late. Holds the events
/// of that last while back. Packets that are in order are handed on without a copy.
class EventOrder {
 public:
  /// Throws std::invalid_argument unless `reorder_us` is from 0 to
  /// EventFileOptions::kMostReorderUs.
  explicit EventOrder(std::int64_t reorder_us);

  /// Takes the events of a packet, and leaves an empty one. None may be more than `reorder_us`
  /// older than the newest before it.
  void add(EventPacket& packet);

  /// Nothing follows: hands out all.
  void finish() { is_finished_ = true; }

  /// Replaces the events in `packet` by the next ones, at most `max_events`. Returns false, with an
  /// empty packet, while none is ready.
  bool take(EventPacket& packet, std::size_t max_events);

  bool is_empty() const { return queue_.empty(); }
  /// Events that were out of order.
  std::int64_t reordered() const { return reordered_; }

 private:
  struct TimedEvent {
    Timestamp time;
    Event event;
  };

  bool is_in_order(const EventPacket& packet) const;
  void merge(const EventPacket& packet);
  void push_merged();
  EventPacket& push_empty();

  std::int64_t reorder_us_;
  std::deque<EventPacket> queue_;
  std::size_t front_taken_ = 0;  // Events of the first packet that were handed out.
  Timestamp newest_;             // While the queue is not empty.
  bool is_finished_ = false;
  std::int64_t reordered_ = 0;
  std::vector<EventPacket> spare_;  // Empty ones, for their memory.
  std::vector<TimedEvent> merged_;
};

}  // namespace puck
