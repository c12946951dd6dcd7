#include "tools/doctor/host_clocks.h"

namespace puck {

void HostClocks::hear(const HeardService& service, std::int64_t heard_monotonic_us) {
  const service_status_t& status = service.status;
  for (std::size_t i = 0; i < status.pong_session.size(); ++i) {
    if (status.pong_session[i] != session_) continue;
    const bool is_good = clocks_.add(
        status.session,
        {status.pong_utime[i], status.pong_received_utime[i], status.utime, heard_monotonic_us});
    if (is_good) runs_[status.session] = {service.source.address, status.host};
  }
}

std::map<std::string, HostClock> HostClocks::offsets(const HostNow& now) const {
  std::map<std::string, HostClock> offsets;
  for (const auto& [session, run] : runs_) {
    const SenderClock clock = clocks_.offset_of(session, now);
    if (!clock) continue;
    const HostClock offset{run.host, clock->ahead_us, clock->uncertainty_us};
    const auto [known, is_new] = offsets.try_emplace(run.address, offset);
    if (!is_new && offset.within_us < known->second.within_us) known->second = offset;
  }
  return offsets;
}

}  // namespace puck
