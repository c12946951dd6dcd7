#include "tools/doctor/host_clocks.h"

#include <algorithm>

namespace puck {

void HostClocks::sent(std::int64_t utime) {
  pings_.push_back(utime);
  if (pings_.size() > kMaxPings) pings_.pop_front();
}

void HostClocks::hear(const HeardService& service) {
  const service_status_t& status = service.status;
  for (std::size_t i = 0; i < status.pong_session.size(); ++i) {
    const std::int64_t ping_utime = status.pong_utime[i];
    const bool is_ours = status.pong_session[i] == session_ &&
                         std::find(pings_.begin(), pings_.end(), ping_utime) != pings_.end();
    if (!is_ours) continue;
    // All of these are positive and below 2^53: nothing overflows.
    const std::int64_t there_us = status.utime - status.pong_received_utime[i];
    const std::int64_t away_us = service.heard_utime - ping_utime;
    const std::int64_t round_trip_us = away_us - there_us;
    if (there_us < 0 || round_trip_us < 0) continue;  // A clock was set meanwhile.
    const std::int64_t out_us = status.pong_received_utime[i] - ping_utime;
    const std::int64_t back_us = status.utime - service.heard_utime;
    const HostClock offset{status.host, (out_us + back_us) / 2, (round_trip_us + 1) / 2};
    const auto [known, is_new] = offsets_.try_emplace(service.source.address, offset);
    if (!is_new && offset.within_us < known->second.within_us) known->second = offset;
  }
}

}  // namespace puck
