#include "common/calibration/truth_motion.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace puck {
namespace {

constexpr double kWhole = 0.99;
// Events are delayed, so a bounce affects a longer time after it than before.
constexpr std::int64_t kBeforeUs = 2'000;
constexpr std::int64_t kAfterUs = 8'000;
// Change of velocity from row to row that hand-annotated truth may show without a bounce.
constexpr double kChangePx_s = 100;
constexpr double kMarkedChangeOfSpeed = 0.2;
// Between rows farther apart the motion is unknown.
constexpr std::int64_t kLongestGapUs = 50'000;

}  // namespace

TruthMotion::TruthMotion(std::span<const TruthRow> rows) : rows_(rows.begin(), rows.end()) {
  if (rows_.empty()) throw std::invalid_argument("the truth has no rows");
  const auto disorder =
      std::adjacent_find(rows_.begin(), rows_.end(),
                         [](const TruthRow& a, const TruthRow& b) { return a.time >= b.time; });
  if (disorder != rows_.end())
    throw std::invalid_argument("the truth's times must increase from row to row");
  for (std::size_t i = 1; i + 1 < rows_.size(); ++i) {
    if (!is_steady(i)) uncertain_.push_back(rows_[i].time);
  }
}

PixelVelocity TruthMotion::velocity_between(std::size_t from, std::size_t to) const {
  const TruthRow& a = rows_[from];
  const TruthRow& b = rows_[to];
  const double seconds = static_cast<double>(b.time - a.time) * 1e-6;
  return {(b.centre.x - a.centre.x) / seconds, (b.centre.y - a.centre.y) / seconds};
}

bool TruthMotion::is_steady(std::size_t row) const {
  if (rows_[row].visible < kWhole) return false;
  if (rows_[row + 1].time - rows_[row].time > kLongestGapUs) return false;
  const PixelVelocity before = velocity_between(row - 1, row);
  const PixelVelocity after = velocity_between(row, row + 1);
  const double change = std::hypot(after.x - before.x, after.y - before.y);
  return change < kChangePx_s + kMarkedChangeOfSpeed * std::hypot(after.x, after.y);
}

std::optional<TruthMotion::State> TruthMotion::at(Timestamp time) const {
  const auto after =
      std::upper_bound(rows_.begin(), rows_.end(), time,
                       [](Timestamp t, const TruthRow& row) { return t < row.time; });
  const auto next = static_cast<std::size_t>(after - rows_.begin());
  if (next < 2 || next + 1 >= rows_.size()) return std::nullopt;
  const auto uncertain = std::lower_bound(uncertain_.begin(), uncertain_.end(), time - kAfterUs);
  if (uncertain != uncertain_.end() && *uncertain <= time + kBeforeUs) return std::nullopt;
  const TruthRow& a = rows_[next - 1];
  const TruthRow& b = rows_[next];
  if (a.visible < kWhole || b.visible < kWhole || b.time - a.time > kLongestGapUs) {
    return std::nullopt;
  }
  const double share = static_cast<double>(time - a.time) / static_cast<double>(b.time - a.time);
  return State{{a.centre.x + share * (b.centre.x - a.centre.x),
                a.centre.y + share * (b.centre.y - a.centre.y)},
               velocity_between(next - 2, next + 1)};
}

bool TruthMotion::ever_visible() const {
  return std::any_of(rows_.begin(), rows_.end(),
                     [](const TruthRow& row) { return row.visible >= kWhole; });
}

}  // namespace puck
