#include "tools/spy/pages.h"

#include <vector>

#include "tools/spy/message_lines.h"
#include "tools/spy/short_text.h"
#include "tools/spy/tables.h"

namespace puck {

Screen help_page() {
  Screen screen;
  // At most as wide as the smallest screen and as high as a usual one.
  for (const char* line : {
           "up, down, k, j  select a row; page keys, home, end",
           "enter           show the row: its newest message, decoded",
           "esc             back",
           "s, r            sort by the next column; reverse",
           "p, space        pause what is shown; goes on listening",
           "o               foreign traffic on this group and port",
           "h, q            this page; quit",
           "",
           "CHANNELS        counts since the start, rates of the last second",
           "MSG/S, B/S      messages and bytes, valid or not",
           "EV/S            events in PUCK_EVENTS",
           "RECVD           valid messages",
           "LOST, LATE, DUP by the numbers of each publisher's run",
           "BAD             malformed, too large or without our key",
           "RUNS            runs of publishers that were heard",
           "AGE             since the newest message",
           "AT ONCE         several publishers where one is expected",
           "SERVICES        from PUCK_STATUS",
           "AGE             since the last; silent after 0.5 s",
           "us p50/p99/max  latencies, microseconds",
           "!               lost, late or bad lately; silent, degraded",
       }) {
    screen.push_back({line});
  }
  return screen;
}

Screen others_page(const BusSnapshot& snapshot, std::size_t width) {
  const TransportCounters& network = snapshot.network;
  Screen screen;
  for (std::string& line : foreign_table(network.foreign_traffic, width)) {
    screen.push_back({std::move(line)});
  }
  screen[0].style = LineStyle::kHead;
  screen.push_back({});
  const auto add = [&](const char* what, std::int64_t count) {
    screen.push_back({std::string(what) + ": " + std::to_string(count)});
  };
  add("foreign datagrams, total", network.foreign);
  add("malformed datagrams on PUCK channels", network.malformed);
  add("without our key on unknown PUCK channels", snapshot.unknown_unauthenticated);
  add("times the network came back", network.rejoined);
  return screen;
}

ScreenLine others_line(const TransportCounters& network) {
  return {short_count(network.foreign) + " foreign datagrams (press o)", LineStyle::kWarning};
}

Screen silence_page(const std::string& waiting_for, const TransportCounters& network,
                    std::size_t width) {
  std::vector<std::string> lines{"", "no message received yet; puck-doctor finds the cause"};
  if (!waiting_for.empty()) add_field(lines, "waiting", waiting_for, width);
  Screen screen;
  for (std::string& line : lines) screen.push_back({std::move(line), LineStyle::kWarning});
  if (network.foreign > 0) screen.push_back(others_line(network));
  return screen;
}

}  // namespace puck
