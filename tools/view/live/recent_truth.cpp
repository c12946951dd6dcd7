#include "tools/view/live/recent_truth.h"

#include <algorithm>

namespace puck {
namespace {

constexpr std::int64_t kKept_us = 500'000;
constexpr std::int64_t kLongestGap_us = 20'000;

}  // namespace

void RecentTruth::add(const TruthRow& row) {
  if (!rows_.empty() && row.time <= rows_.back().time) {
    if (row.time == rows_.back().time) return;
    rows_.clear();
  }
  rows_.push_back(row);
  while (row.time - rows_.front().time > kKept_us) rows_.pop_front();
}

std::optional<TruthRow> RecentTruth::at(Timestamp time) const {
  const auto later =
      std::lower_bound(rows_.begin(), rows_.end(), time,
                       [](const TruthRow& row, Timestamp t) { return row.time < t; });
  if (later == rows_.end()) {
    if (rows_.empty() || time - rows_.back().time > kLongestGap_us) return std::nullopt;
    return rows_.back();
  }
  if (later->time == time) return *later;
  if (later == rows_.begin()) return std::nullopt;
  return TruthTrack({*(later - 1), *later}).at(time, kLongestGap_us);
}

}  // namespace puck
