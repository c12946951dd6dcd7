#pragma once

#include <cstdint>
#include <optional>

#include "common/messages/host_now.h"

namespace puck {

/// Offset of another run's clock, which stamps its messages, to this host's CLOCK_REALTIME.
struct ClockOffset {
  std::int64_t ahead_us = 0;        ///< Its time minus ours.
  std::int64_t uncertainty_us = 0;  ///< Bound of the error of `ahead_us`.

  /// Converts a time of that clock to our clock.
  constexpr std::int64_t to_own(std::int64_t utime) const { return utime - ahead_us; }
};

/// Empty until the offset has been measured.
using SenderClock = std::optional<ClockOffset>;

enum class Freshness : std::uint8_t {
  kOfNow,
  kOld,
  kFromFuture,
  kClockUnknown,  ///< The sender's clock is unknown or too uncertain.
};

/// Whether the age of `utime`, by the sender's clock, is certain to be within plus and minus
/// `max_error_us`. `utime` may have any value; the comparison cannot overflow.
constexpr Freshness freshness_of(std::int64_t utime, const HostNow& now, const SenderClock& clock,
                                 std::int64_t max_error_us) {
  if (!clock || clock->uncertainty_us > max_error_us) return Freshness::kClockUnknown;
  const std::int64_t sender_now = now.utime + clock->ahead_us;
  const std::int64_t allowed_us = max_error_us - clock->uncertainty_us;
  if (utime < sender_now - allowed_us) return Freshness::kOld;
  if (utime > sender_now + allowed_us) return Freshness::kFromFuture;
  return Freshness::kOfNow;
}

}  // namespace puck
