#pragma once

#include <cstdint>

#include "common/messaging/host_time.h"

namespace puck {

/// One moment by both clocks of this host.
struct HostNow {
  std::int64_t utime = 0;         ///< CLOCK_REALTIME, µs: compared with what others wrote.
  std::int64_t monotonic_us = 0;  ///< CLOCK_MONOTONIC: ages on this host.
};

inline HostNow host_now() { return {host_utime(), host_monotonic_us()}; }

/// Whether what was sent at `utime`, by the sender's clock, is neither older nor from further in
/// the future than `max_error_us`. The sender's clock may say anything, so nothing is subtracted
/// from it.
constexpr bool is_of_now(std::int64_t utime, const HostNow& now, std::int64_t max_error_us) {
  return utime >= now.utime - max_error_us && utime <= now.utime + max_error_us;
}

}  // namespace puck
