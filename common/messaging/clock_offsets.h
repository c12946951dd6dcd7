#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/messages/clock_offset.h"
#include "common/messages/host_now.h"

namespace puck {

/// An answer to one of our pings.
struct ClockAnswer {
  std::int64_t ping_utime = 0;          ///< The ping's utime, by our clock; identifies the ping.
  std::int64_t received_utime = 0;      ///< Arrival of the ping, by the answerer's clock.
  std::int64_t answered_utime = 0;      ///< Publication of the answer, by the same clock.
  std::int64_t heard_monotonic_us = 0;  ///< Arrival of the answer here, CLOCK_MONOTONIC.
};

/// Measures the clocks of other runs from answered pings, as NTP does: of the newest exchanges, the
/// one with the shortest round trip counts, since half of it bounds the error. Offsets are relative
/// to CLOCK_MONOTONIC, so a step of our own clock changes nothing; a step of theirs is accepted
/// after two exchanges in a row. A run that does not answer our recent pings takes no memory and
/// has no offset: a foreign sender, or a replayed log. One thread.
class ClockOffsets {
 public:
  static constexpr std::size_t kSessions = 64;

  /// Notes a message of ours that others answer.
  void ping(const HostNow& sent);
  /// Returns false for an answer to none of the newest pings, or one that contradicts itself.
  bool add(std::int64_t session, const ClockAnswer& answer);

  /// The uncertainty grows with the time since the last answer. The offset is exactly 0 for a clock
  /// that agrees with ours within the uncertainty.
  SenderClock offset_of(std::int64_t session, const HostNow& now) const;

  std::size_t sessions() const { return clocks_.size(); }

 private:
  static constexpr std::size_t kPings = 32;      // 3 s of STATUS
  static constexpr std::size_t kExchanges = 32;  // per session

  struct Exchange {
    std::int64_t ahead_us = 0;  // their CLOCK_REALTIME minus our CLOCK_MONOTONIC
    std::int64_t uncertainty_us = 0;
    std::int64_t heard_us = 0;  // CLOCK_MONOTONIC

    std::int64_t uncertainty_at(std::int64_t monotonic_us) const;
    bool agrees_with(const Exchange& other) const;
  };

  struct Clock {
    std::int64_t session = 0;
    std::vector<Exchange> exchanges;  // the newest ones, at most kExchanges, as a ring
    std::size_t next = 0;             // index of the next one in the ring
    Exchange best;
    std::optional<Exchange> doubter;  // the newest that contradicts `best`
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
