#include "tools/spy/overview.h"

#include <algorithm>
#include <vector>

#include "tools/spy/details.h"
#include "tools/spy/tables.h"

namespace puck {
namespace {

/// The visible rows of a table.
struct Window {
  std::size_t first = 0;
  std::size_t count = 0;
};

template <typename Row>
Window window_around(const std::vector<Row>& rows, const std::string& selected, std::size_t room) {
  const std::size_t count = std::min(rows.size(), room);
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const Row& row) { return row_id(row) == selected; });
  const auto place = found == rows.end() ? 0 : static_cast<std::size_t>(found - rows.begin());
  const std::size_t centred = place - std::min(place, count / 2);
  return {std::min(centred, rows.size() - count), count};
}

template <typename Row>
void add_table(Screen& screen, const std::vector<Row>& rows, const std::vector<std::string>& table,
               const std::string& selected, std::size_t room) {
  const Window window = window_around(rows, selected, room);
  ScreenLine head{table[0], LineStyle::kHead};
  if (window.count < rows.size()) {
    // In place of the first column's head, which is wide enough.
    const std::string more = std::to_string(window.first + 1) + '-' +
                             std::to_string(window.first + window.count) + " of " +
                             std::to_string(rows.size());
    const std::size_t at = 2;
    if (head.text.size() >= at + more.size()) head.text.replace(at, more.size(), more);
  }
  screen.push_back(head);
  for (std::size_t i = window.first; i < window.first + window.count; ++i) {
    screen.push_back({table[i + 1], style_of(rows[i]), row_id(rows[i]) == selected});
  }
}

}  // namespace

std::string row_id(const ChannelRow& channel) { return "channel " + channel.name; }

std::string row_id(const ServiceRow& service) {
  return "service " + std::to_string(service.session);
}

Screen draw_overview(const BusSnapshot& snapshot, const std::string& selected, ScreenSize size) {
  constexpr int kHeads = 2;
  const auto width = static_cast<std::size_t>(size.columns);
  const auto room = static_cast<std::size_t>(std::max(size.rows - kHeads, 0));
  const auto& channels = snapshot.channels;
  const auto& services = snapshot.services;
  Screen screen;
  const std::size_t rows = channels.size() + services.size();
  std::size_t service_room = services.size();
  // Both tables shrink in proportion.
  if (rows > room) service_room = (room * services.size() + rows / 2) / rows;
  const std::size_t channel_room = room - std::min(room, service_room);
  add_table(screen, channels, channel_table(channels, width), selected, channel_room);
  if (rows < room) screen.push_back({});
  add_table(screen, services, service_table(services, width), selected, service_room);
  return screen;
}

}  // namespace puck
