#include "tools/view/live/live_messages.h"

namespace puck {
namespace {

double in_seconds(std::int64_t duration_us) { return static_cast<double>(duration_us) / 1e6; }

std::optional<std::int64_t> measured(const StatusLatency& latency, std::int64_t value) {
  if (latency.samples == 0) return std::nullopt;
  return value;
}

}  // namespace

std::vector<ViewService> view_services(const BusSnapshot& snapshot) {
  std::vector<ViewService> services;
  for (const ServiceRow& row : snapshot.services) {
    ViewService& service = services.emplace_back();
    service.name = row.service;
    service.host = row.host;
    service.pid = row.pid;
    service.state = state_of(row);
    service.state_text = row.state_text;
    service.is_healthy = !row.silent && row.state == ServiceState::kRunning;
    service.age_s = in_seconds(row.status_age_us);
    service.uptime_s = in_seconds(row.uptime_us);
    service.counters = row.counters;
    for (const StatusLatency& latency : row.latencies) {
      service.latencies.push_back({latency.name, measured(latency, latency.p50_us),
                                   measured(latency, latency.p99_us),
                                   measured(latency, latency.max_us)});
    }
  }
  return services;
}

std::vector<ViewChannel> view_channels(const BusSnapshot& snapshot) {
  std::vector<ViewChannel> channels;
  for (const ChannelRow& row : snapshot.channels) {
    ViewChannel& channel = channels.emplace_back();
    channel.name = row.name;
    channel.messages_per_s = row.messages_per_s;
    channel.bytes_per_s = row.bytes_per_s;
    channel.received = row.arrivals.received;
    channel.lost = row.arrivals.lost;
    channel.late = row.arrivals.late;
    channel.malformed = row.malformed + row.oversize + row.unauthenticated;
    if (row.newest_age_us) channel.age_s = in_seconds(*row.newest_age_us);
    channel.is_in_trouble = row.in_trouble || row.several_publishers;
  }
  return channels;
}

}  // namespace puck
