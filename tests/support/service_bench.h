#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <thread>

#include <spdlog/logger.h>
#include <spdlog/sinks/null_sink.h>

#include "common/messaging/bus.h"
#include "common/messaging/status_reporter.h"
#include "services/launch/bus_watch.h"
#include "services/launch/rate_limited_log.h"
#include "services/launch/service.h"
#include "tests/support/wait_until.h"

namespace puck {

/// A service in a thread of its own, on a bus that the test shares with it. Subscribe after
/// construction, then start.
class ServiceBench {
 public:
  explicit ServiceBench(const std::string& url = "memq://")
      : bus({.url = url}), status(bus, "puck-test") {}

  template <typename ServiceType, typename Params>
  void make(const Params& params) {
    service = std::make_unique<ServiceType>(params, context);
  }
  bool start() {
    if (!bus.start({}, [](const std::string&) {})) return false;
    thread_ = std::jthread([this](const std::stop_token& stop) { service->run(stop); });
    return true;
  }
  void stop() {
    if (!thread_.joinable()) return;
    thread_.request_stop();
    thread_.join();
  }

  /// Does `step` once a millisecond until `condition` holds; false after 20 s.
  static bool until(const std::function<bool()>& condition, const std::function<void()>& step) {
    return wait_until([&] {
      if (condition()) return true;
      step();
      return false;
    });
  }

  Bus bus;
  StatusReporter status;
  spdlog::logger log{"test", std::make_shared<spdlog::sinks::null_sink_mt>()};
  RateLimitedLog limited_log{log};
  BusWatch bus_watch{bus, log};
  PeerWatch peers{status, log};
  ServiceContext context{bus, status, log, limited_log, bus_watch, peers};
  std::unique_ptr<Service> service;

 private:
  std::jthread thread_;
};

}  // namespace puck
