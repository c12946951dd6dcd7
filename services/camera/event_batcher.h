#pragma once

#include <cstddef>
#include <cstdint>

#include "common/events/event_packet.h"

namespace puck {

/// Gathers events until there are enough for a packet, or until the first of them has waited for
/// long enough. Knows sensor time only.
class EventBatcher {
 public:
  /// Throws std::invalid_argument for a limit below 1.
  EventBatcher(std::size_t max_events, std::int64_t max_age_us);

  /// Takes events from `packet`, from index `next` on, until the batch is complete or they are used
  /// up. Events come in the order of their times.
  void take(const EventPacket& packet, std::size_t& next);

  /// Whether it has to go when no more events come before `until`.
  bool is_complete(Timestamp until) const;
  /// When it may go: with its last event when it is full, else when its age is up. The batch must
  /// not be empty.
  Timestamp due() const;

  const EventPacket& batch() const { return batch_; }
  void clear() { batch_.events.clear(); }

 private:
  bool is_full() const { return batch_.events.size() >= max_events_; }
  Timestamp window_end() const { return batch_.start + max_age_us_; }

  std::size_t max_events_;
  std::int64_t max_age_us_;
  EventPacket batch_;
};

}  // namespace puck
