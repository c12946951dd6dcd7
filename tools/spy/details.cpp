#include "tools/spy/details.h"

#include <string>
#include <vector>

#include "common/messaging/wire_layout.h"
#include "tools/spy/column_layout.h"
#include "tools/spy/message_lines.h"
#include "tools/spy/short_text.h"
#include "tools/spy/tables.h"

namespace puck {
namespace {

/// Head and row as in the overview.
void add_row(Screen& screen, const std::vector<std::string>& table, LineStyle style) {
  screen.push_back({table[0], LineStyle::kHead});
  screen.push_back({table[1], style});
}

void add(Screen& screen, const std::vector<std::string>& lines,
         LineStyle style = LineStyle::kPlain) {
  for (const std::string& line : lines) screen.push_back({line, style});
}

void add_head(Screen& screen, std::string text) {
  screen.push_back({});
  screen.push_back({std::move(text), LineStyle::kHead});
}

Column publisher_column(const ChannelRow& channel, Column made, const auto& cell) {
  for (const PublisherRow& publisher : channel.publishers) made.cells.push_back(cell(publisher));
  return made;
}

void add_publishers(Screen& screen, const ChannelRow& channel, std::size_t width) {
  const auto make = [&](Column made, const auto& cell) {
    return publisher_column(channel, made, cell);
  };
  using Row = PublisherRow;
  const std::vector<std::string> table = lay_out(
      {
          make({"PUBLISHER", false, 0, 16},
               [](const Row& row) { return row.service.empty() ? "no STATUS" : row.service; }),
          make({"PID", true, 1, 7},
               [](const Row& row) { return row.pid == 0 ? "" : std::to_string(row.pid); }),
          make({"HOST", false, 2, 8}, [](const Row& row) { return row.host; }),
          make({"ADDRESS", false, 6, 16}, [](const Row& row) { return to_string(row.sender); }),
          make({"MESSAGES", true, 3, 8}, [](const Row& row) { return short_count(row.messages); }),
          make({"AGE", true, 4, 6}, [](const Row& row) { return short_duration(row.age_us); }),
          make({"SESSION", true, 5, 16},
               [](const Row& row) { return std::to_string(row.session); }),
      },
      width);
  add_head(screen, table[0]);
  const LineStyle style = channel.several_publishers ? LineStyle::kAlarm : LineStyle::kPlain;
  for (std::size_t i = 1; i < table.size(); ++i) screen.push_back({table[i], style});
}

Column latency_column(const ServiceRow& service, Column made, const auto& cell) {
  for (const StatusLatency& latency : service.latencies) made.cells.push_back(cell(latency));
  return made;
}

void add_latencies(Screen& screen, const ServiceRow& service, std::size_t width) {
  const auto make = [&](Column made, const auto& cell) {
    return latency_column(service, made, cell);
  };
  using Row = StatusLatency;
  // A row without samples has no values.
  const auto measured = [](const Row& row, std::int64_t value) {
    return row.samples == 0 ? "" : std::to_string(value);
  };
  const std::vector<std::string> table = lay_out(
      {
          make({"LATENCY, us", false, 0, 24}, [](const Row& row) { return row.name; }),
          make({"P50", true, 1, 8}, [&](const Row& row) { return measured(row, row.p50_us); }),
          make({"P99", true, 2, 8}, [&](const Row& row) { return measured(row, row.p99_us); }),
          make({"MAX", true, 3, 8}, [&](const Row& row) { return measured(row, row.max_us); }),
          make({"SAMPLES", true, 4, 8}, [](const Row& row) { return std::to_string(row.samples); }),
      },
      width);
  add_head(screen, table[0]);
  for (std::size_t i = 1; i < table.size(); ++i) screen.push_back({table[i]});
}

}  // namespace

LineStyle style_of(const ChannelRow& channel) {
  if (channel.several_publishers) return LineStyle::kAlarm;
  if (is_marked(channel)) return LineStyle::kWarning;
  return channel.messages_per_s > 0 ? LineStyle::kPlain : LineStyle::kFaint;
}

LineStyle style_of(const ServiceRow& service) {
  if (is_marked(service)) return LineStyle::kAlarm;
  if (service.state == ServiceState::kRunning) return LineStyle::kPlain;
  return service.state == ServiceState::kStopping ? LineStyle::kFaint : LineStyle::kWarning;
}

Screen channel_details(const ChannelRow& channel, std::size_t width) {
  Screen screen;
  add_row(screen, channel_table({channel}, width), style_of(channel));
  if (!channel.last_rejection.empty()) {
    std::vector<std::string> why;
    add_field(why, "last bad message", channel.last_rejection, width);
    add(screen, why, LineStyle::kWarning);
  }
  if (!channel.publishers.empty()) add_publishers(screen, channel, width);
  if (!channel.type || channel.newest.empty()) return screen;
  add_head(screen, std::string(wire_layout(*channel.type).type) + ", " +
                       std::to_string(channel.newest.size()) + " bytes");
  add(screen, message_lines(*channel.type, channel.newest, width));
  return screen;
}

Screen service_details(const ServiceRow& service, std::size_t width) {
  Screen screen;
  add_row(screen, service_table({service}, width), style_of(service));
  std::vector<std::string> who{""};
  add_field(who, "host", service.host, width);
  add_field(who, "pid", std::to_string(service.pid), width);
  add_field(who, "version", service.version, width);
  add_field(who, "session", std::to_string(service.session), width);
  add_field(who, "state", state_of(service), width);
  add_field(who, "state text", service.state_text, width);
  add(screen, who);
  if (!service.latencies.empty()) add_latencies(screen, service, width);
  if (service.counters.empty()) return screen;
  add_head(screen, "COUNTERS");
  std::vector<std::string> counters;
  for (const auto& [name, value] : service.counters) {
    add_field(counters, plain_text(name), std::to_string(value), width);
  }
  add(screen, counters);
  return screen;
}

}  // namespace puck
