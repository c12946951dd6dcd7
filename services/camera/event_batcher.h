#pragma once

#include <cstddef>
#include <cstdint>

#include "common/events/event_packet.h"

namespace puck {

/// Collects events until they fill a packet or the first of them has waited long enough; it waits
/// longer while there are few events, as in a still scene. In sensor time only.
class EventBatcher {
 public:
  /// This many events do not wait longer than usual. A moving puck causes them within a fraction of
  /// a pixel.
  static constexpr std::size_t kFew = 32;

  /// `quiet_age_us`: longest age with fewer than kFew events; at least `max_age_us`. Throws
  /// std::invalid_argument for a limit below 1.
  EventBatcher(std::size_t max_events, std::int64_t max_age_us, std::int64_t quiet_age_us);

  /// Changes the limits of the ages, as above.
  void set_ages(std::int64_t max_age_us, std::int64_t quiet_age_us);

  /// Takes events from `packet`, from index `next` on, until the batch is complete or no event is
  /// left. Events come in the order of their times.
  void take(const EventPacket& packet, std::size_t& next);

  /// Whether the batch must go if no more events come before `until`.
  bool is_complete(Timestamp until) const;
  /// Time at which the batch may go: that of its last event if full, else the end of its window.
  /// Requires a batch that is not empty.
  Timestamp due() const;

  /// Longest present age of the first event.
  std::int64_t age_limit_us() const { return has_few() ? quiet_age_us_ : max_age_us_; }

  const EventPacket& batch() const { return batch_; }
  void clear() { batch_.events.clear(); }

 private:
  void take_until(const EventPacket& packet, std::size_t& next, std::size_t most);
  bool is_full() const { return batch_.events.size() >= max_events_; }
  bool has_few() const { return batch_.events.size() < kFew; }
  Timestamp window_end() const { return batch_.start + age_limit_us(); }

  std::size_t max_events_;
  std::int64_t max_age_us_ = 1;
  std::int64_t quiet_age_us_ = 1;
  EventPacket batch_;
};

}  // namespace puck
