#include "tools/doctor/live_services.h"

#include "tools/doctor/doctor_name.h"

namespace puck {

std::vector<const HeardService*> live_services(const Facts& facts) {
  // STATUS comes every 100 ms.
  constexpr std::int64_t kSilentAfter_us = 1'000'000;
  std::vector<const HeardService*> live;
  for (const auto& [session, service] : facts.traffic.services()) {
    const bool is_silent = facts.end_utime - service.heard_utime > kSilentAfter_us;
    const bool has_stopped = service.status.state == service_status_t::STATE_STOPPING;
    if (!is_silent && !has_stopped && service.status.service != kDoctorName) {
      live.push_back(&service);
    }
  }
  return live;
}

}  // namespace puck
