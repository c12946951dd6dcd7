#pragma once

#include <string>
#include <vector>

#include "tools/spy/channel_sort.h"
#include "tools/spy/screen.h"
#include "tools/spy/snapshot.h"

namespace puck {

/// What is looked at, and how: turns snapshots into lines for a screen of any size and keys into
/// what is shown next. Knows no terminal. One thread.
class SpyView {
 public:
  /// `bus`: what is listened to, for the first line.
  explicit SpyView(std::string bus) : bus_(std::move(bus)) {}

  /// What is shown while nothing has come.
  void set_notice(std::string notice) { notice_ = std::move(notice); }

  /// The snapshot is replaced by newer ones, unless paused.
  void show(Snapshot snapshot);
  void press(SpyKey key);
  bool is_paused() const { return paused_; }
  bool wants_to_quit() const { return quit_; }

  /// As many lines as the screen has rows, but for those at the end that would be empty.
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
  Snapshot heard_;
  Snapshot shown_;  // The same, its channels sorted.
  Page page_ = Page::kOverview;
  ChannelSort sort_ = ChannelSort::kFlow;
  bool reverse_ = false;
  bool paused_ = false;
  bool quit_ = false;
  std::string selected_;  // A row_id.
  std::size_t scroll_ = 0;
  std::size_t page_rows_ = 1;  // Lines that the last screen had for what scrolls.
};

}  // namespace puck
