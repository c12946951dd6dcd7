#pragma once

#include <cstdint>

namespace puck {

/// CLOCK_REALTIME, µs since 1970: `utime` on the wire. It may step; never measure durations by it.
std::int64_t host_utime();

/// CLOCK_MONOTONIC, µs: for durations and ages on this host.
std::int64_t host_monotonic_us();

}  // namespace puck
