#include "common/evaluation/score_curve.h"

#include <algorithm>
#include <cmath>

namespace puck {

void ScoreCurve::add(double score, double error_px) {
  // NaN counts as the lowest score.
  const double clamped = std::isnan(score) ? 0 : std::clamp(score, 0.0, 1.0);
  const auto step = static_cast<std::size_t>(std::floor(clamped * kSteps));
  ++ticks_[step];
  if (error_px <= kRightPx) ++right_[step];
}

double ScoreCurve::Point::f1() const {
  return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0;
}

ScoreCurve::Point ScoreCurve::at(int step) const {
  Point point;
  point.threshold = static_cast<double>(step) / kSteps;
  std::int64_t all_right = 0;
  for (int i = 0; i <= kSteps; ++i) {
    const auto index = static_cast<std::size_t>(i);
    all_right += right_[index];
    if (i < step) continue;
    point.believed += ticks_[index];
    point.right += right_[index];
  }
  const auto right = static_cast<double>(point.right);
  if (point.believed > 0) point.precision = right / static_cast<double>(point.believed);
  if (all_right > 0) point.recall = right / static_cast<double>(all_right);
  return point;
}

ScoreCurve::Point ScoreCurve::best() const {
  Point best = at(0);
  for (int step = 1; step <= kSteps; ++step) {
    const Point point = at(step);
    if (point.f1() >= best.f1()) best = point;
  }
  return best;
}

double ScoreCurve::average_precision() const {
  double area = 0;
  Point above = at(kSteps);
  area += above.recall * above.precision;
  for (int step = kSteps - 1; step >= 0; --step) {
    const Point point = at(step);
    area += (point.recall - above.recall) * point.precision;
    above = point;
  }
  return area;
}

}  // namespace puck
