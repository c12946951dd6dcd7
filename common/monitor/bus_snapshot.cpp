#include "common/monitor/bus_snapshot.h"

namespace puck {

std::string state_of(const ServiceRow& service) {
  if (service.silent) return "silent";
  return service.state == ServiceState::kStopping ? "stopped" : to_string(service.state);
}

}  // namespace puck
