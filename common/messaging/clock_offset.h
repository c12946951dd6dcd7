#pragma once

#include <cstdint>
#include <optional>

#include "common/messaging/host_now.h"

namespace puck {

/// How the clock that another run stamps its messages with stands to this host's CLOCK_REALTIME.
struct ClockOffset {
  std::int64_t ahead_us = 0;        ///< Its time minus ours.
  std::int64_t uncertainty_us = 0;  ///< `ahead_us` is off by no more than this.

  /// A time by that clock, by ours.
  constexpr std::int64_t to_own(std::int64_t utime) const { return utime - ahead_us; }
};

/// Nothing as long as it has not been measured.
using SenderClock = std::optional<ClockOffset>;

enum class Freshness : std::uint8_t {
  kOfNow,
  kOld,
  kFromFuture,
  kClockUnknown,  ///< The sender's clock is not known, or not well enough to tell.
};

/// Whether what was sent at `utime`, by the sender's clock, is certain to be neither older nor from
/// further in the future than `max_error_us`. `utime` may be anything, so nothing is subtracted
/// from it.
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
