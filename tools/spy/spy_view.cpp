#include "tools/spy/spy_view.h"

#include <algorithm>

#include "tools/spy/details.h"
#include "tools/spy/overview.h"
#include "tools/spy/pages.h"
#include "tools/spy/short_text.h"
#include "tools/spy/tables.h"

namespace puck {

void SpyView::show(BusSnapshot snapshot) {
  if (paused_) return;
  heard_ = std::move(snapshot);
  sort_channels();
  keep_selection();
}

void SpyView::sort_channels() {
  shown_ = heard_;
  shown_.channels = sorted(std::move(shown_.channels), sort_, reverse_);
}

void SpyView::press(SpyKey key) {
  switch (key) {
    case SpyKey::kQuit:
      quit_ = true;
      break;
    case SpyKey::kPause:
      paused_ = !paused_;
      break;
    case SpyKey::kSort:
      sort_ = next_sort(sort_);
      sort_channels();
      break;
    case SpyKey::kReverse:
      reverse_ = !reverse_;
      sort_channels();
      break;
    case SpyKey::kShow:
      if (!selected_.empty() || page_ != Page::kOverview) toggle(Page::kDetails);
      break;
    case SpyKey::kOthers:
      toggle(Page::kOthers);
      break;
    case SpyKey::kHelp:
      toggle(Page::kHelp);
      break;
    case SpyKey::kBack:
      page_ = Page::kOverview;
      break;
    default:
      move(key);
  }
}

/// From a page back to the overview; enter shows details from the overview only.
void SpyView::toggle(Page page) {
  const bool enters = page_ != page && (page != Page::kDetails || page_ == Page::kOverview);
  page_ = enters ? page : Page::kOverview;
  scroll_ = 0;
}

void SpyView::move(SpyKey key) {
  const std::vector<std::string> ids = row_ids();
  const bool selecting = page_ == Page::kOverview;
  std::size_t at = scroll_;
  if (selecting) {
    at = static_cast<std::size_t>(std::find(ids.begin(), ids.end(), selected_) - ids.begin());
  }
  // draw() limits a position beyond the end.
  constexpr std::size_t kEnd = 1'000'000;
  const std::size_t page = std::max<std::size_t>(page_rows_, 1);
  if (key == SpyKey::kUp) at -= std::min<std::size_t>(at, 1);
  if (key == SpyKey::kDown) ++at;
  if (key == SpyKey::kPageUp) at -= std::min(at, page);
  if (key == SpyKey::kPageDown) at += page;
  if (key == SpyKey::kFirst) at = 0;
  if (key == SpyKey::kLast) at = kEnd;
  if (!selecting) {
    scroll_ = at;
  } else if (!ids.empty()) {
    selected_ = ids[std::min(at, ids.size() - 1)];
  }
}

/// Selects the first row if none is selected or the selected one is gone, except on the details
/// page, which keeps its subject.
void SpyView::keep_selection() {
  const std::vector<std::string> ids = row_ids();
  const bool there = std::find(ids.begin(), ids.end(), selected_) != ids.end();
  if (!there && page_ != Page::kDetails) selected_ = ids.empty() ? "" : ids.front();
}

std::vector<std::string> SpyView::row_ids() const {
  std::vector<std::string> ids;
  for (const ChannelRow& channel : shown_.channels) ids.push_back(row_id(channel));
  for (const ServiceRow& service : shown_.services) ids.push_back(row_id(service));
  return ids;
}

Screen SpyView::draw(ScreenSize size) {
  const auto width = static_cast<std::size_t>(std::max(size.columns, 0));
  const auto rows = static_cast<std::size_t>(std::max(size.rows, 0));
  constexpr std::size_t kFrame = 2;  // Title and status line.
  const std::size_t room = rows - std::min(rows, kFrame);
  Screen screen = body({static_cast<int>(width), static_cast<int>(room)});
  const std::size_t lines = screen.size();
  scroll(screen, room);
  std::string last = keys();
  if (lines > room) {
    last = std::to_string(scroll_ + 1) + '-' + std::to_string(scroll_ + room) + " of " +
           std::to_string(lines) + "  " + last;
  }
  screen.insert(screen.begin(), title(width));
  screen.push_back({std::move(last), LineStyle::kTitle});
  if (screen.size() > rows) screen.resize(rows);
  for (ScreenLine& line : screen) line.text = fit_left(line.text, width);
  return screen;
}

/// Scrolls a body that does not fit; keeps the last line at the bottom of the screen.
void SpyView::scroll(Screen& body, std::size_t room) {
  page_rows_ = room;
  if (page_ == Page::kOverview) scroll_ = 0;
  scroll_ = std::min(scroll_, body.size() - std::min(body.size(), room));
  body.erase(body.begin(), body.begin() + static_cast<std::ptrdiff_t>(scroll_));
  body.resize(room);
}

ScreenLine SpyView::title(std::size_t width) const {
  std::size_t marked = 0;
  for (const ChannelRow& channel : shown_.channels) marked += is_marked(channel) ? 1 : 0;
  for (const ServiceRow& service : shown_.services) marked += is_marked(service) ? 1 : 0;
  const std::string right = (paused_ ? "PAUSED  " : "") +
                            (marked > 0 ? '!' + std::to_string(marked) + "  " : "") + "sorted by " +
                            to_string(sort_) + (reverse_ ? " reversed" : "") + "  " +
                            short_duration(shown_.listened_us);
  const std::size_t left = width - std::min(width, right.size() + 1);
  return {fit_left("puck-spy  " + bus_, left) + ' ' + right, LineStyle::kTitle};
}

Screen SpyView::body(ScreenSize size) const {
  const auto width = static_cast<std::size_t>(size.columns);
  if (page_ == Page::kHelp) return help_page();
  if (page_ == Page::kDetails) return details(width);
  if (page_ == Page::kOthers) return others_page(shown_, width);
  if (shown_.channels.empty()) return silence_page(notice_, shown_.network, width);
  const bool alone = shown_.network.foreign == 0;
  Screen screen = draw_overview(shown_, selected_, {size.columns, size.rows - (alone ? 0 : 1)});
  if (!alone) screen.push_back(others_line(shown_.network));
  add_preview(screen, size);
  return screen;
}

/// Shows the selected row's details in the empty space.
void SpyView::add_preview(Screen& screen, ScreenSize size) const {
  constexpr std::size_t kLeast = 8;
  constexpr std::size_t kRow = 2;  // The row itself and its head are on the screen already.
  const auto rows = static_cast<std::size_t>(size.rows);
  if (screen.size() + kLeast > rows) return;
  Screen preview = details(static_cast<std::size_t>(size.columns));
  if (preview.size() <= kRow) return;
  const std::size_t shown = std::min(preview.size() - kRow, rows - screen.size());
  const auto first = preview.begin() + kRow;
  screen.insert(screen.end(), first, first + static_cast<std::ptrdiff_t>(shown));
}

Screen SpyView::details(std::size_t width) const {
  for (const ChannelRow& channel : shown_.channels) {
    if (row_id(channel) == selected_) return channel_details(channel, width);
  }
  for (const ServiceRow& service : shown_.services) {
    if (row_id(service) == selected_) return service_details(service, width);
  }
  return {{"it is no longer received", LineStyle::kWarning}};
}

std::string SpyView::keys() const {
  if (page_ == Page::kOverview) {
    return "q quit  enter show  s sort  r reverse  p pause  h help";
  }
  return std::string("esc back  up/down scroll  p ") + (paused_ ? "go on" : "pause") + "  q quit";
}

}  // namespace puck
