#pragma once

#include <string>
#include <vector>

#include "common/monitor/bus_snapshot.h"
#include "tools/spy/channel_sort.h"
#include "tools/spy/screen.h"

namespace puck {

/// State of the display: turns snapshots into lines for a screen of any size, and keys into the
/// next page. Independent of the terminal. One thread.
class SpyView {
 public:
  /// `bus`: its description, for the title.
  explicit SpyView(std::string bus) : bus_(std::move(bus)) {}

  /// Text before the first message.
  void set_notice(std::string notice) { notice_ = std::move(notice); }

  /// Replaces the shown snapshot, unless paused.
  void show(BusSnapshot snapshot);
  void press(SpyKey key);
  bool is_paused() const { return paused_; }
  bool wants_to_quit() const { return quit_; }

  /// At most as many lines as the screen has rows; empty lines at the end are left out.
  Screen draw(ScreenSize size);

 private:
  enum class Page { kOverview, kDetails, kOthers, kHelp };

  void toggle(Page page);
  void sort_channels();
  void move(SpyKey key);
  void keep_selection();
  std::vector<std::string> row_ids() const;

  ScreenLine title(std::size_t width) const;
  Screen body(ScreenSize size) const;
  void add_preview(Screen& screen, ScreenSize size) const;
  Screen details(std::size_t width) const;
  std::string keys() const;
  void scroll(Screen& body, std::size_t room);

  std::string bus_;
  std::string notice_;
  BusSnapshot heard_;
  BusSnapshot shown_;  // shown with sorted channels
  Page page_ = Page::kOverview;
  ChannelSort sort_ = ChannelSort::kFlow;
  bool reverse_ = false;
  bool paused_ = false;
  bool quit_ = false;
  std::string selected_;  // A row_id.
  std::size_t scroll_ = 0;
  std::size_t page_rows_ = 1;  // Rows of the scrolled part at the last draw.
};

}  // namespace puck
