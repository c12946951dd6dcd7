#pragma once

#include <cstddef>
#include <cstdint>

#include "common/events/event_packet.h"

namespace puck {

/// Gathers events until there are enough for a packet, or until the first of them has waited for
/// long enough: for longer while there are only a few, as in a scene where nothing moves. Knows
/// sensor time only.
class EventBatcher {
 public:
  /// So many events do not wait for longer than usual. A moving puck makes them within a fraction
  /// of a pixel.
  static constexpr std::size_t kFew = 32;

  /// `quiet_age_us`: the age while there are fewer than kFew; no less than `max_age_us`. Throws
  /// std::invalid_argument for a limit below 1.
  EventBatcher(std::size_t max_events, std::int64_t max_age_us, std::int64_t quiet_age_us);

  /// Takes events from `packet`, from index `next` on, until the batch is complete or they are used
  /// up. Events come in the order of their times.
  void take(const EventPacket& packet, std::size_t& next);

  /// Whether it has to go when no more events come before `until`.
  bool is_complete(Timestamp until) const;
  /// When it may go: with its last event when it is full, else when its age is up. The batch must
  /// not be empty.
  Timestamp due() const;

  /// How long the first event may wait now.
  std::int64_t age_limit_us() const { return has_few() ? quiet_age_us_ : max_age_us_; }

  const EventPacket& batch() const { return batch_; }
  void clear() { batch_.events.clear(); }

 private:
  void take_until(const EventPacket& packet, std::size_t& next, std::size_t most);
  bool is_full() const { return batch_.events.size() >= max_events_; }
  bool has_few() const { return batch_.events.size() < kFew; }
  Timestamp window_end() const { return batch_.start + age_limit_us(); }

  std::size_t max_events_;
  std::int64_t max_age_us_;
  std::int64_t quiet_age_us_;
  EventPacket batch_;
};

}  // namespace puck
