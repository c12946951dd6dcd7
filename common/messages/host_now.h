#pragma once

#include <cstdint>

#include "common/messages/host_time.h"

namespace puck {

/// The same moment by both clocks of this host.
struct HostNow {
  std::int64_t utime = 0;         ///< CLOCK_REALTIME, µs: for times of other hosts.
  std::int64_t monotonic_us = 0;  ///< CLOCK_MONOTONIC, µs: for ages on this host.
};

inline HostNow host_now() { return {host_utime(), host_monotonic_us()}; }

}  // namespace puck
