#pragma once

#include <stop_token>

#include <spdlog/logger.h>

#include "common/messaging/bus.h"
#include "common/messaging/status_reporter.h"
#include "services/launch/bus_watch.h"
#include "services/launch/peer_watch.h"
#include "services/launch/rate_limited_log.h"

namespace puck {

/// Passed to every service, which it outlives.
struct ServiceContext {
  Bus& bus;  ///< Not started yet during the service's constructor, which subscribes.
  StatusReporter& status;
  /// Call it with complete texts, if needed from fmt::format(): other arguments would compile the
  /// formatter again in each file that logs.
  spdlog::logger& log;
  RateLimitedLog& limited_log;
  BusWatch& bus_watch;
  PeerWatch& peers;
};

/// The interface of a service for run_service().
class Service {
 public:
  virtual ~Service() = default;

  /// Works until a stop is requested, then returns within 100 ms with all data written; a service
  /// that moves an arm returns once it has come to rest. Calls context.bus.handle() and
  /// poll_status() at least every 20 ms. Exceptions end the service with exit code 1.
  virtual void run(std::stop_token stop) = 0;

  /// Adds its counters and latencies to STATUS.
  virtual void report(StatusReport& report) const = 0;
};

/// Publishes STATUS and logs problems of the bus and of other services, each when due.
void poll_status(ServiceContext& context, const Service& service);

}  // namespace puck
