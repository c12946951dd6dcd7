#pragma once

#include <cstdint>
#include <vector>

#include "common/messaging/channels.h"
#include "common/monitor/bus_snapshot.h"
#include "common/monitor/monitor_params.h"

namespace puck {

/// The services, from STATUS. Keeps the 64 heard last.
class ServiceList {
 public:
  explicit ServiceList(const MonitorParams& params) : params_(params) {}

  void hear(const service_status_t& status, std::int64_t now_us);

  /// By name, host and pid. Leaves out an ended or silent run if a newer run of the same service on
  /// the same host was heard.
  std::vector<ServiceRow> rows(std::int64_t now_us) const;

  /// Fills in the service of the publisher's session, if its STATUS was heard.
  void name(PublisherRow& publisher) const;

 private:
  struct Heard {
    ServiceRow row;
    std::int64_t first_us = 0;  // CLOCK_MONOTONIC
    std::int64_t last_us = 0;   // CLOCK_MONOTONIC
  };

  Heard& place_of(std::int64_t session, std::int64_t now_us);
  bool is_replaced(const Heard& service) const;

  MonitorParams params_;
  std::vector<Heard> heard_;
};

}  // namespace puck
