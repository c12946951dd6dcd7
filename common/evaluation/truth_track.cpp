#include "common/evaluation/truth_track.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace puck {
namespace {

constexpr double kMotionPx = 5;

double between(double a, double b, double fraction) { return a + fraction * (b - a); }

}  // namespace

TruthTrack::TruthTrack(std::vector<TruthRow> rows) : rows_(std::move(rows)) {
  if (rows_.empty()) throw std::invalid_argument("the truth has no rows");
  const auto disorder =
      std::adjacent_find(rows_.begin(), rows_.end(),
                         [](const TruthRow& a, const TruthRow& b) { return a.time >= b.time; });
  if (disorder != rows_.end())
    throw std::invalid_argument("the truth's times must increase from row to row");
}

std::optional<TruthRow> TruthTrack::at(Timestamp time, std::int64_t longest_gap_us) const {
  if (time < rows_.front().time || time > rows_.back().time) return std::nullopt;
  const auto after =
      std::lower_bound(rows_.begin(), rows_.end(), time,
                       [](const TruthRow& row, Timestamp t) { return row.time < t; });
  if (after->time == time) return *after;
  const TruthRow& a = *(after - 1);
  const TruthRow& b = *after;
  if (b.time - a.time > longest_gap_us) return std::nullopt;
  const double f = static_cast<double>(time - a.time) / static_cast<double>(b.time - a.time);
  return TruthRow{
      time,
      {between(a.centre.x, b.centre.x, f), between(a.centre.y, b.centre.y, f)},
      {between(a.size.width, b.size.width, f), between(a.size.height, b.size.height, f)},
      between(a.visible, b.visible, f)};
}

std::optional<Timestamp> TruthTrack::first_motion() const {
  const Pixel start = rows_.front().centre;
  const auto moved = std::find_if(rows_.begin(), rows_.end(), [&](const TruthRow& row) {
    return std::hypot(row.centre.x - start.x, row.centre.y - start.y) > kMotionPx;
  });
  if (moved == rows_.end()) return std::nullopt;
  return moved->time;
}

}  // namespace puck
