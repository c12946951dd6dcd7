#include "common/monitor/service_list.h"

#include <algorithm>
#include <tuple>

namespace puck {
namespace {

constexpr std::size_t kMaxServices = 64;

ServiceRow row_of(const service_status_t& status) {
  ServiceRow row{.session = status.session,
                 .service = status.service,
                 .host = status.host,
                 .pid = status.pid,
                 .version = status.version,
                 .state = static_cast<ServiceState>(status.state),
                 .state_text = status.state_text,
                 .uptime_us = status.uptime_us};
  for (std::size_t i = 0; i < status.counter_name.size(); ++i) {
    row.counters.emplace_back(status.counter_name[i], status.counter_value[i]);
  }
  for (std::size_t i = 0; i < status.latency_name.size(); ++i) {
    row.latencies.push_back({status.latency_name[i], status.latency_p50_us[i],
                             status.latency_p99_us[i], status.latency_max_us[i],
                             status.latency_samples[i]});
  }
  return row;
}

}  // namespace

void ServiceList::hear(const service_status_t& status, std::int64_t now_us) {
  Heard& heard = place_of(status.session, now_us);
  heard.row = row_of(status);
  heard.last_us = now_us;
}

ServiceList::Heard& ServiceList::place_of(std::int64_t session, std::int64_t now_us) {
  const auto known = std::find_if(heard_.begin(), heard_.end(), [session](const Heard& other) {
    return other.row.session == session;
  });
  if (known != heard_.end()) return *known;
  const Heard added{.first_us = now_us};
  if (heard_.size() < kMaxServices) return heard_.emplace_back(added);
  const auto longest_silent =
      std::min_element(heard_.begin(), heard_.end(),
                       [](const Heard& a, const Heard& b) { return a.last_us < b.last_us; });
  return *longest_silent = added;
}

std::vector<ServiceRow> ServiceList::rows(std::int64_t now_us) const {
  std::vector<ServiceRow> rows;
  for (const Heard& heard : heard_) {
    const std::int64_t age_us = std::max<std::int64_t>(now_us - heard.last_us, 0);
    const bool quiet = age_us > params_.silent_after_us;
    const bool stopped = heard.row.state == ServiceState::kStopping;
    if (age_us > params_.service_life_us || ((quiet || stopped) && is_replaced(heard))) continue;
    ServiceRow& row = rows.emplace_back(heard.row);
    row.status_age_us = age_us;
    row.silent = quiet && !stopped;
  }
  std::sort(rows.begin(), rows.end(), [](const ServiceRow& a, const ServiceRow& b) {
    return std::tie(a.service, a.host, a.pid, a.session) <
           std::tie(b.service, b.host, b.pid, b.session);
  });
  return rows;
}

bool ServiceList::is_replaced(const Heard& service) const {
  return std::any_of(heard_.begin(), heard_.end(), [&](const Heard& other) {
    return other.row.service == service.row.service && other.row.host == service.row.host &&
           other.first_us > service.last_us;
  });
}

void ServiceList::name(PublisherRow& publisher) const {
  for (const Heard& heard : heard_) {
    if (heard.row.session != publisher.session) continue;
    publisher.service = heard.row.service;
    publisher.host = heard.row.host;
    publisher.pid = heard.row.pid;
  }
}

}  // namespace puck
