#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/messaging/clock_offset.h"
#include "common/messaging/host_now.h"

namespace puck {

/// What came back for one of our pings.
struct ClockAnswer {
  std::int64_t ping_utime = 0;          ///< The ping's utime, by our clock: which ping it was.
  std::int64_t received_utime = 0;      ///< When it came there, by the answerer's clock.
  std::int64_t answered_utime = 0;      ///< When the answer was published, by the same clock.
  std::int64_t heard_monotonic_us = 0;  ///< When that came here, CLOCK_MONOTONIC.
};

/// Measures the clocks of other runs from pings that they answered, as NTP does: of the newest
/// exchanges the one with the shortest round trip counts, as its half bounds the error. All is kept
/// against CLOCK_MONOTONIC, so a step of our own clock changes nothing; a step of theirs is
/// believed when two exchanges in a row tell of it. Whoever does not answer our own, recent pings
/// takes no memory and has no offset: neither strangers nor a log that is played. One thread.
class ClockOffsets {
 public:
  static constexpr std::size_t kSessions = 64;

  /// Something was published that others answer.
  void ping(const HostNow& sent);
  /// False when it answers none of the newest pings or contradicts itself.
  bool add(std::int64_t session, const ClockAnswer& answer);

  /// Less sure as time goes by without another answer. Exactly 0 for a clock that cannot be told
  /// from ours.
  SenderClock offset_of(std::int64_t session, const HostNow& now) const;

  std::size_t sessions() const { return clocks_.size(); }

 private:
  static constexpr std::size_t kPings = 32;      // 3 s of STATUS
  static constexpr std::size_t kExchanges = 32;  // of a session

  struct Exchange {
    std::int64_t ahead_us = 0;  // their CLOCK_REALTIME minus our CLOCK_MONOTONIC
    std::int64_t uncertainty_us = 0;
    std::int64_t heard_us = 0;  // CLOCK_MONOTONIC

    std::int64_t uncertainty_at(std::int64_t monotonic_us) const;
    bool agrees_with(const Exchange& other) const;
  };

  struct Clock {
    std::int64_t session = 0;
    std::vector<Exchange> exchanges;  // the newest, at most kExchanges; not in order
    std::size_t next = 0;             // place of the next one
    Exchange best;
    std::optional<Exchange> doubter;  // the newest that contradicted the best
    std::int64_t heard_us = 0;        // CLOCK_MONOTONIC

    void add(const Exchange& exchange);
    void keep(const Exchange& exchange);
  };

  Clock& clock_of(std::int64_t session);

  std::array<HostNow, kPings> pings_{};
  std::size_t next_ping_ = 0;
  std::vector<Clock> clocks_;  // At most kSessions.
};

}  // namespace puck
