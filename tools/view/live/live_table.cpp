#include "tools/view/live/live_table.h"

#include "tools/view/table/table_messages.h"

namespace puck {
namespace {

constexpr std::int64_t kStaleAfter_us = 500'000;

}  // namespace

std::optional<ViewTable> LiveTable::table(std::int64_t now_us) const {
  if (!trajectory_.message && !arm_.message && !game_.message && !truth_.message) {
    return std::nullopt;
  }
  ViewTable table;
  const auto take_fresh = [&](const auto& newest) {
    if (newest.message && now_us - newest.time_us <= kStaleAfter_us)
      puck::take(*newest.message, table);
  };
  take_fresh(trajectory_);
  take_fresh(arm_);
  take_fresh(game_);
  take_fresh(truth_);
  return table;
}

}  // namespace puck
