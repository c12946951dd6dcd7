#include "tools/spy/tables.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "tools/spy/column_layout.h"
#include "tools/spy/short_text.h"

namespace puck {
namespace {

template <typename Row, typename Cell>
Column column(const std::vector<Row>& rows, Column made, const Cell& cell) {
  for (const Row& row : rows) made.cells.push_back(cell(row));
  return made;
}

constexpr auto kMark = [](const auto& row) { return std::string(is_marked(row) ? "!" : ""); };

/// The current publisher; of successive ones, the newest; null unless there is exactly one.
const PublisherRow* only_publisher(const ChannelRow& channel) {
  const bool one = !channel.publishers.empty() && !channel.several_publishers &&
                   channel.type != Channel::kStatus;
  return one ? &channel.publishers.back() : nullptr;
}

/// A short list of the publishers.
std::string publishers_of(const ChannelRow& channel) {
  if (const PublisherRow* one = only_publisher(channel)) {
    return one->service.empty() ? describe(*one) : one->service;
  }
  const std::size_t count = channel.publishers.size();
  if (count == 0) return channel.type ? "" : "not a PUCK channel";
  if (!channel.several_publishers) {
    return std::to_string(count) + (count == 1 ? " service" : " services");
  }
  std::string text = std::to_string(count) + " AT ONCE";
  for (const PublisherRow& publisher : channel.publishers) text += ", " + describe(publisher);
  return text;
}

std::string pid_of(const ChannelRow& channel) {
  const PublisherRow* one = only_publisher(channel);
  return one == nullptr || one->service.empty() ? "" : std::to_string(one->pid);
}

std::string host_of(const ChannelRow& channel) {
  const PublisherRow* one = only_publisher(channel);
  return one == nullptr ? "" : one->host;
}

bool ends_with_any(std::string_view name, const auto& ends) {
  return std::any_of(ends.begin(), ends.end(),
                     [name](std::string_view end) { return name.ends_with(end); });
}

/// The service's main latency comes first.
std::string latencies_of(const ServiceRow& service) {
  constexpr std::array<std::string_view, 3> kWork{"packet_to_estimate", "to_command", "to_motion"};
  std::string first;
  std::string others;
  for (const StatusLatency& latency : service.latencies) {
    if (latency.samples == 0) continue;
    std::string& place = ends_with_any(latency.name, kWork) ? first : others;
    place += (place.empty() ? "" : ", ") + describe(latency);
  }
  return first + (first.empty() || others.empty() ? "" : ", ") + others;
}

/// Counters that are not 0, errors first, as space may be short; without those of a channel
/// ("CHANNEL.name") that the channels' table shows.
std::string counters_of(const ServiceRow& service) {
  constexpr std::array<std::string_view, 16> kTroubles{
      "_lost",        "_late",     "_rejected",  "_dropped", "_skipped",  "_thinned",
      "_refused",     "_failures", "_malformed", "_others",  "_oversize", "_foreign",
      "_not_written", "faults",    "_clock",     "_left_out"};
  std::string troubles;
  std::string others;
  for (const auto& [name, value] : service.counters) {
    const bool trouble = ends_with_any(name, kTroubles);
    if (value == 0 || (!trouble && name.find('.') != std::string::npos)) continue;
    std::string& place = trouble ? troubles : others;
    place += (place.empty() ? "" : ", ") + name + ' ' + short_count(value);
  }
  return troubles + (troubles.empty() || others.empty() ? "" : ", ") + others;
}

}  // namespace

bool is_marked(const ChannelRow& channel) {
  return channel.several_publishers || channel.in_trouble || !channel.type;
}

bool is_marked(const ServiceRow& service) {
  return service.silent || service.state == ServiceState::kDegraded;
}

std::string describe(const PublisherRow& publisher) {
  if (publisher.service.empty()) return to_string(publisher.sender);
  return publisher.service + ' ' + std::to_string(publisher.pid) + ' ' + publisher.host;
}

std::string describe(const StatusLatency& latency) {
  return short_count(latency.p50_us) + '/' + short_count(latency.p99_us) + '/' +
         short_count(latency.max_us) + ' ' + latency.name;
}

std::vector<std::string> channel_table(const std::vector<ChannelRow>& channels, std::size_t width) {
  const auto make = [&](Column made, const auto& cell) { return column(channels, made, cell); };
  using Row = ChannelRow;
  return lay_out(
      {
          make({"", false, 0, 1}, kMark),
          make({"CHANNEL", false, 0, 16}, [](const Row& row) { return row.name; }),
          make({"MSG/S", true, 1, 5},
               [](const Row& row) { return short_rate(row.messages_per_s); }),
          make({"B/S", true, 2, 5}, [](const Row& row) { return short_rate(row.bytes_per_s); }),
          make({"EV/S", true, 7, 5},
               [](const Row& row) {
                 return row.type == Channel::kEvents ? short_rate(row.events_per_s) : "";
               }),
          make({"RECVD", true, 8, 5},
               [](const Row& row) { return short_count(row.arrivals.received); }),
          make({"LOST", true, 3, 5}, [](const Row& row) { return short_count(row.arrivals.lost); }),
          make({"LATE", true, 9, 4}, [](const Row& row) { return short_count(row.arrivals.late); }),
          make({"DUP", true, 10, 3},
               [](const Row& row) { return short_count(row.arrivals.duplicates); }),
          make({"BAD", true, 6, 3},
               [](const Row& row) {
                 return short_count(row.malformed + row.oversize + row.unauthenticated);
               }),
          make({"RUNS", true, 11, 4},
               [](const Row& row) { return short_count(row.arrivals.sessions); }),
          make({"AGE", true, 4, 6},
               [](const Row& row) {
                 return row.newest_age_us ? short_duration(*row.newest_age_us) : "";
               }),
          make({"FROM", false, 5, 12}, publishers_of),
          make({"PID", true, 12, 7}, pid_of),
          make({"HOST", false, 13, 8}, host_of),
      },
      width);
}

std::vector<std::string> foreign_table(const std::vector<ForeignTraffic>& foreign,
                                       std::size_t width) {
  const auto make = [&](Column made, const auto& cell) { return column(foreign, made, cell); };
  using Row = ForeignTraffic;
  return lay_out(
      {
          make({"FOREIGN TRAFFIC", false, 0, 30}, [](const Row& row) { return row.what; }),
          make({"DATAGRAMS", true, 2, 9},
               [](const Row& row) { return short_count(row.datagrams); }),
          make({"FROM", false, 1, 16}, [](const Row& row) { return to_string(row.sender); }),
      },
      width);
}

std::vector<std::string> service_table(const std::vector<ServiceRow>& services, std::size_t width) {
  const auto make = [&](Column made, const auto& cell) { return column(services, made, cell); };
  using Row = ServiceRow;
  return lay_out(
      {
          make({"", false, 0, 1}, kMark),
          make({"SERVICE", false, 0, 12}, [](const Row& row) { return row.service; }),
          make({"STATE", false, 1, 8}, state_of),
          make({"AGE", true, 2, 6},
               [](const Row& row) { return short_duration(row.status_age_us); }),
          make({"UP", true, 5, 6}, [](const Row& row) { return short_duration(row.uptime_us); }),
          make({"PID", true, 6, 7}, [](const Row& row) { return std::to_string(row.pid); }),
          make({"HOST", false, 7, 8}, [](const Row& row) { return row.host; }),
          make({"VERSION", false, 9, 7}, [](const Row& row) { return row.version; }),
          make({"STATE TEXT", false, 3, 10}, [](const Row& row) { return row.state_text; }),
          make({"us p50/p99/max", false, 4, 18}, latencies_of),
          make({"COUNTERS", false, 8, 20}, counters_of),
      },
      width);
}

}  // namespace puck
