#include "common/messaging/status_check.h"

#include "common/messaging/status_reporter.h"

namespace puck {
namespace {

constexpr std::chrono::milliseconds kStep{20};

bool is_healthy(ServiceState state) {
  return state == ServiceState::kRunning || state == ServiceState::kWaiting;
}

std::string describe(const service_status_t& status) {
  std::string text = status.service + " on " + status.host + ", pid " + std::to_string(status.pid) +
                     ", is " + to_string(static_cast<ServiceState>(status.state));
  if (!status.state_text.empty()) text += ": " + status.state_text;
  return text;
}

}  // namespace

StatusCheck check_service(const BusParams& params, const std::string& service,
                          std::chrono::milliseconds timeout, std::stop_token stop) {
  const auto end = std::chrono::steady_clock::now() + timeout;
  StatusCheck check{false, "no " + service + " is heard on " + params.url};
  Bus bus(params);
  bus.subscribe<service_status_t>([&](const service_status_t& status, const Receipt&) {
    if (check.healthy || status.service != service) return;
    check = {is_healthy(static_cast<ServiceState>(status.state)), describe(status)};
  });

  // Without a route there is nothing to receive; the wait for one must end at the timeout.
  std::stop_source give_up;
  const std::stop_callback on_stop(stop, [&] { give_up.request_stop(); });
  const bool started = bus.start(give_up.get_token(), [&](const std::string& reason) {
    check.text = reason;
    give_up.request_stop();
  });
  while (started && !check.healthy && !stop.stop_requested() &&
         std::chrono::steady_clock::now() < end) {
    bus.handle(kStep);
  }
  return check;
}

}  // namespace puck
