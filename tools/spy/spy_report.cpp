#include "tools/spy/spy_report.h"

#include <cmath>

#include <nlohmann/json.hpp>

#include "common/messaging/wire_layout.h"
#include "tools/spy/tables.h"

namespace puck {
namespace {

using Json = nlohmann::ordered_json;

double in_seconds(std::int64_t duration_us) { return static_cast<double>(duration_us) / 1e6; }
double in_milliseconds(std::int64_t duration_us) { return static_cast<double>(duration_us) / 1e3; }
/// Rounds to one decimal.
double rate(double per_second) { return std::round(per_second * 10) / 10; }

Json json_of(const ChannelRow& channel) {
  return {
      {"channel", channel.name},
      {"type", channel.type ? std::string(wire_layout(*channel.type).type) : ""},
      {"messages_per_s", rate(channel.messages_per_s)},
      {"bytes_per_s", rate(channel.bytes_per_s)},
      {"events_per_s", rate(channel.events_per_s)},
      {"received", channel.arrivals.received},
      {"received_bytes", channel.received_bytes},
      {"lost", channel.arrivals.lost},
      {"late", channel.arrivals.late},
      {"duplicate", channel.arrivals.duplicates},
      {"malformed", channel.malformed},
      {"oversize", channel.oversize},
      {"unauthenticated", channel.unauthenticated},
      {"last_rejection", channel.last_rejection},
      {"events_lost", channel.arrivals.items_lost},
      {"sessions", channel.arrivals.sessions},
      {"publishers", channel.publishers.size()},
      {"several_publishers", channel.several_publishers},
      {"age_ms", channel.newest_age_us ? Json(in_milliseconds(*channel.newest_age_us)) : Json()},
  };
}

Json json_of(const PublisherRow& publisher, const std::string& channel) {
  return {
      {"channel", channel},
      {"service", publisher.service},
      {"host", publisher.host},
      {"pid", publisher.pid},
      {"session", publisher.session},
      {"address", to_string(publisher.sender)},
      {"messages", publisher.messages},
      {"age_ms", in_milliseconds(publisher.age_us)},
  };
}

Json json_of(const ForeignTraffic& traffic) {
  return {
      {"what", traffic.what},
      {"address", to_string(traffic.sender)},
      {"datagrams", traffic.datagrams},
  };
}

Json json_of(const ServiceRow& service) {
  Json row{
      {"service", service.service},
      {"host", service.host},
      {"pid", service.pid},
      {"version", service.version},
      {"session", service.session},
      {"state", state_of(service)},
      {"state_text", service.state_text},
      {"silent", service.silent},
      {"uptime_s", in_seconds(service.uptime_us)},
      {"status_age_ms", in_milliseconds(service.status_age_us)},
  };
  for (const StatusLatency& latency : service.latencies) {
    const std::string name = "latency_" + latency.name;
    const auto measured = [&latency](std::int64_t value) {
      return latency.samples == 0 ? Json() : Json(value);
    };
    row[name + "_p50_us"] = measured(latency.p50_us);
    row[name + "_p99_us"] = measured(latency.p99_us);
    row[name + "_max_us"] = measured(latency.max_us);
    row[name + "_samples"] = latency.samples;
  }
  for (const auto& [name, value] : service.counters) row["counter_" + name] = value;
  return row;
}

std::string text_of(const std::vector<std::string>& table) {
  std::string text;
  for (const std::string& line : table) text += line + '\n';
  return text;
}

}  // namespace

std::string json_report(const BusSnapshot& snapshot, const std::string& url,
                        const std::string& prefix) {
  Json report{
      {"url", url},
      {"prefix", prefix},
      {"seconds", in_seconds(snapshot.listened_us)},
      {"messages", snapshot.messages},
      {"foreign_datagrams", snapshot.network.foreign},
      {"malformed_datagrams", snapshot.network.malformed},
      {"unknown_unauthenticated", snapshot.unknown_unauthenticated},
      {"channels", Json::array()},
      {"publishers", Json::array()},
      {"services", Json::array()},
      {"foreign", Json::array()},
  };
  for (const ChannelRow& channel : snapshot.channels) {
    report["channels"].push_back(json_of(channel));
    for (const PublisherRow& publisher : channel.publishers) {
      report["publishers"].push_back(json_of(publisher, channel.name));
    }
  }
  for (const ServiceRow& service : snapshot.services)
    report["services"].push_back(json_of(service));
  for (const ForeignTraffic& traffic : snapshot.network.foreign_traffic) {
    report["foreign"].push_back(json_of(traffic));
  }
  // Text from the network may not be UTF-8.
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string text_report(const BusSnapshot& snapshot, std::size_t width) {
  std::string text;
  const auto add = [&](const auto& rows, const auto& table) {
    if (!rows.empty()) text += (text.empty() ? "" : "\n") + text_of(table(rows, width));
  };
  add(snapshot.channels, channel_table);
  add(snapshot.services, service_table);
  add(snapshot.network.foreign_traffic, foreign_table);
  return text;
}

}  // namespace puck
