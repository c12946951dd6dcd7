#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "common/messaging/status_reporter.h"
#include "puck/service_status_t.hpp"

namespace puck::test {

/// Empty if the counter is not reported.
inline std::optional<std::int64_t> counter(const StatusReport& report, const std::string& name) {
  for (const auto& [its_name, count] : report.counters) {
    if (its_name == name) return count;
  }
  return std::nullopt;
}

/// The same for a received report.
inline std::optional<std::int64_t> counter(const service_status_t& status,
                                           const std::string& name) {
  for (std::size_t i = 0; i < status.counter_name.size(); ++i) {
    if (status.counter_name[i] == name) return status.counter_value[i];
  }
  return std::nullopt;
}

/// A service's present report. The service has stopped, or allows reports from any thread.
template <typename ServiceType>
std::optional<std::int64_t> counter(const ServiceType& service, const std::string& name) {
  StatusReport report;
  service.report(report);
  return counter(report, name);
}

}  // namespace puck::test
