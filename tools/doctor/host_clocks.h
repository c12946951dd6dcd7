#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "common/messaging/clock_offsets.h"
#include "tools/doctor/traffic.h"

namespace puck {

/// Offset of another host's clock.
struct HostClock {
  std::string host;            ///< Host name in its STATUS.
  std::int64_t offset_us = 0;  ///< Its clock minus ours.
  std::int64_t within_us = 0;  ///< Bound on the error of the offset.
};

/// Measures clock offsets from the pongs in others' STATUS to our STATUS. Of all runs on a host,
/// the one with the smallest error bound counts. One thread.
class HostClocks {
 public:
  /// `session`: that of our pings.
  explicit HostClocks(std::int64_t session) : session_(session) {}

  /// For each STATUS that we publish: its utime, and our CLOCK_MONOTONIC before the stamp, never
  /// after.
  void sent(const HostNow& ping) { clocks_.ping(ping); }
  void hear(const HeardService& service, std::int64_t heard_monotonic_us);

  /// By address.
  std::map<std::string, HostClock> offsets(const HostNow& now) const;

 private:
  struct Run {
    std::string address;
    std::string host;
  };

  std::int64_t session_;
  ClockOffsets clocks_;
  std::map<std::int64_t, Run> runs_;  // By session; bounded by Traffic.
};

}  // namespace puck
