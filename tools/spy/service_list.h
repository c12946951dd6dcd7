#pragma once

#include <cstdint>
#include <vector>

#include "common/messaging/channels.h"
#include "tools/spy/snapshot.h"
#include "tools/spy/spy_params.h"

namespace puck {

/// The services, from what they say in STATUS. The 64 heard last are known.
class ServiceList {
 public:
  explicit ServiceList(const SpyParams& params) : params_(params) {}

  void hear(const service_status_t& status, std::int64_t now_us);

  /// By name, host and pid. A run that has ended or fallen silent is left out when a younger one of
  /// the same service on the same host has been heard.
  std::vector<ServiceRow> rows(std::int64_t now_us) const;

  /// Fills in who it is, when a STATUS of its session was heard.
  void name(PublisherRow& publisher) const;

 private:
  struct Heard {
    ServiceRow row;
    std::int64_t first_us = 0;  // CLOCK_MONOTONIC
    std::int64_t last_us = 0;   // CLOCK_MONOTONIC
  };

  Heard& place_of(std::int64_t session, std::int64_t now_us);
  bool is_replaced(const Heard& service) const;

  SpyParams params_;
  std::vector<Heard> heard_;
};

}  // namespace puck
