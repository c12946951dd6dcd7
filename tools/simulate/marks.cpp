#include "tools/simulate/marks.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace puck {
namespace {

constexpr double kWhole = 0.99;
// Truth has a row per ms; an annotator would use at most every tenth.
constexpr std::size_t kEveryRow = 10;

double to_half_pixel(double value) { return std::round(2 * value) / 2; }

Annotation mark_of(const TruthRow& row) {
  const double left = to_half_pixel(row.centre.x - row.size.width / 2);
  const double right = to_half_pixel(row.centre.x + row.size.width / 2);
  const double top = to_half_pixel(row.centre.y - row.size.height / 2);
  const double bottom = to_half_pixel(row.centre.y + row.size.height / 2);
  return {row.time, {(left + right) / 2, (top + bottom) / 2}, {right - left, bottom - top}};
}

}  // namespace

std::vector<Annotation> spread_marks(std::span<const TruthRow> truth, int count) {
  std::vector<TruthRow> candidates;
  for (std::size_t i = 0; i < truth.size(); i += kEveryRow) {
    if (truth[i].visible >= kWhole) candidates.push_back(truth[i]);
  }
  // The candidate that is farthest from all chosen ones.
  std::vector<double> distance(candidates.size(), std::numeric_limits<double>::infinity());
  std::vector<Annotation> marks;
  while (static_cast<int>(marks.size()) < count && marks.size() < candidates.size()) {
    const auto farthest = std::max_element(distance.begin(), distance.end());
    if (*farthest <= 0) break;
    const TruthRow& taken = candidates[static_cast<std::size_t>(farthest - distance.begin())];
    marks.push_back(mark_of(taken));
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      distance[i] = std::min(distance[i], std::hypot(candidates[i].centre.x - taken.centre.x,
                                                     candidates[i].centre.y - taken.centre.y));
    }
  }
  std::sort(marks.begin(), marks.end(),
            [](const Annotation& a, const Annotation& b) { return a.time < b.time; });
  return marks;
}

}  // namespace puck
