#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <vector>

#include "common/events/event_packet.h"

namespace puck {

/// Puts events in the order of their times that are up to `reorder_us` too late. Holds the events
/// of that last while back, but no more than kMostHeld, however many there are at one time. Packets
/// that are in order are handed on without a copy.
class EventOrder {
 public:
  /// Throws std::invalid_argument unless `reorder_us` is from 0 to
  /// EventFileOptions::kMostReorderUs.
  explicit EventOrder(std::int64_t reorder_us);

  static constexpr std::size_t kMostHeld = 262'144;

  /// Takes the events of a packet, and leaves an empty one. None may be more than `reorder_us`
  /// older than the newest before it. Drops those that are older than what was handed out.
  void add(EventPacket& packet);

  /// Nothing follows: hands out all.
  void finish() { is_finished_ = true; }

  /// Replaces the events in `packet` by the next ones, at most `max_events`. Returns false, with an
  /// empty packet, while none is ready.
  bool take(EventPacket& packet, std::size_t max_events);

  bool is_empty() const { return queue_.empty(); }
  /// Events that were out of order.
  std::int64_t reordered() const { return reordered_; }
  /// Events that were dropped.
  std::int64_t dropped() const { return dropped_; }

 private:
  struct TimedEvent {
    Timestamp time;
    Event event;
  };

  bool is_in_order(const EventPacket& packet) const;
  void take_note_of(const EventPacket& handed_out);
  void drop_late(EventPacket& packet);
  void merge(const EventPacket& packet);
  void push_merged();
  EventPacket& push_empty();

  std::int64_t reorder_us_;
  std::deque<EventPacket> queue_;
  std::size_t front_taken_ = 0;  // Events of the first packet that were handed out.
  std::size_t held_ = 0;         // Events in the queue.
  Timestamp newest_;             // While the queue is not empty.
  Timestamp handed_out_{std::numeric_limits<std::int64_t>::min()};
  bool is_finished_ = false;
  std::int64_t reordered_ = 0;
  std::int64_t dropped_ = 0;
  std::vector<EventPacket> spare_;  // Empty ones, for their memory.
  std::vector<TimedEvent> merged_;
};

}  // namespace puck
