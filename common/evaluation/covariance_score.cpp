#include "common/evaluation/covariance_score.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/evaluation/quantile.h"

namespace puck {

std::optional<double> normalised_error_squared(const PuckEstimate& estimate, Pixel truth) {
  if (!estimate.position || estimate.state != TrackState::kTracking) return std::nullopt;
  // Upper left 2 × 2 block of the covariance of (x, y, vx, vy).
  const double xx = estimate.covariance[0];
  const double xy = estimate.covariance[1];
  const double yy = estimate.covariance[5];
  if (xx == 0 && xy == 0 && yy == 0) return std::nullopt;
  const double determinant = xx * yy - xy * xy;
  // NaN fails this test, too.
  if (!(xx > 0 && determinant > 0)) return std::numeric_limits<double>::infinity();
  const double dx = estimate.position->x - truth.x;
  const double dy = estimate.position->y - truth.y;
  return (yy * dx * dx - 2 * xy * dx * dy + xx * dy * dy) / determinant;
}

std::optional<CovarianceReport> covariance_report(std::vector<double> normalised_errors_squared) {
  auto& sorted = normalised_errors_squared;
  if (sorted.empty()) return std::nullopt;
  std::sort(sorted.begin(), sorted.end());
  const auto within = std::upper_bound(sorted.begin(), sorted.end(), kNeesBound95);
  double sum = 0;
  double finite = 0;
  for (const double value : sorted) {
    if (!std::isfinite(value)) break;
    sum += value;
    ++finite;
  }
  CovarianceReport report;
  report.estimates = static_cast<std::int64_t>(sorted.size());
  report.nees_mean = finite > 0 ? sum / finite : std::numeric_limits<double>::infinity();
  report.nees_median = quantile(sorted, 0.5);
  report.nees_within_95_percent =
      100 * static_cast<double>(within - sorted.begin()) / static_cast<double>(sorted.size());
  return report;
}

}  // namespace puck
