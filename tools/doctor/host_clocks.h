#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <string>

#include "tools/doctor/traffic.h"

namespace puck {

/// How far another host's clock is from ours.
struct HostClock {
  std::string host;            ///< As its services call it.
  std::int64_t offset_us = 0;  ///< Its clock minus ours.
  std::int64_t within_us = 0;  ///< Half the round trip: the true offset is no further off.
};

/// Measures clocks by the pongs in the STATUS of others to STATUS of ours. Of every host the
/// measurement with the shortest round trip counts. One thread.
class HostClocks {
 public:
  /// `session`: under which our pings go out.
  explicit HostClocks(std::int64_t session) : session_(session) {}

  /// We published a STATUS with this `utime`.
  void sent(std::int64_t utime);
  void hear(const HeardService& service);

  /// By address.
  const std::map<std::string, HostClock>& offsets() const { return offsets_; }

 private:
  static constexpr std::size_t kMaxPings = 64;

  std::int64_t session_;
  std::deque<std::int64_t> pings_;  // The newest; a pong to anything else is made up.
  std::map<std::string, HostClock> offsets_;
};

}  // namespace puck
