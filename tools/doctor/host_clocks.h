#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "common/messaging/clock_offsets.h"
#include "tools/doctor/traffic.h"

namespace puck {

/// How far another host's clock is from ours.
struct HostClock {
  std::string host;            ///< As its services call it.
  std::int64_t offset_us = 0;  ///< Its clock minus ours.
  std::int64_t within_us = 0;  ///< The true offset is no further off.
};

/// Measures clocks by the pongs in the STATUS of others to STATUS of ours. Of all runs on a host
/// the one that is known best counts. One thread.
class HostClocks {
 public:
  /// `session`: under which our pings go out.
  explicit HostClocks(std::int64_t session) : session_(session) {}

  /// We published a STATUS: its utime, and our CLOCK_MONOTONIC just before it was stamped, never
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
  std::map<std::int64_t, Run> runs_;  // By session; as many as Traffic lets through.
};

}  // namespace puck
