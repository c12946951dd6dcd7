#pragma once

#include <stop_token>

#include <spdlog/logger.h>

#include "common/messaging/bus.h"
#include "common/messaging/status_reporter.h"
#include "services/launch/bus_watch.h"
#include "services/launch/peer_watch.h"
#include "services/launch/rate_limited_log.h"

namespace puck {

/// What every service is given. It outlives the service.
struct ServiceContext {
  Bus& bus;  ///< Not started yet when the service is made: it subscribes in its constructor.
  StatusReporter& status;
  /// Takes whole texts, from fmt::format() where need be: with arguments of its own each file that
  /// logs would compile the formatter anew.
  spdlog::logger& log;
  RateLimitedLog& limited_log;
  BusWatch& bus_watch;
  PeerWatch& peers;
};

/// One of the five, as run_service() sees it.
class Service {
 public:
  virtual ~Service() = default;

  /// Works until a stop is requested, and returns within 100 ms of it with everything written; what
  /// moves an arm, once it has come to rest.
  /// Calls context.bus.handle() and poll_status() at least every 20 ms. What it throws ends the
  /// service with exit code 1.
  virtual void run(std::stop_token stop) = 0;

  /// Its counters and latencies for STATUS.
  virtual void report(StatusReport& report) const = 0;
};

/// Publishes STATUS and logs the troubles of the bus and of other services, each when it is due.
void poll_status(ServiceContext& context, const Service& service);

}  // namespace puck
