#include "common/evaluation/error_statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/evaluation/quantile.h"

namespace puck {
namespace {

double percent_within(const std::vector<double>& sorted, double limit_px) {
  const auto beyond = std::upper_bound(sorted.begin(), sorted.end(), limit_px);
  return 100 * static_cast<double>(beyond - sorted.begin()) / static_cast<double>(sorted.size());
}

}  // namespace

ErrorStatistics error_statistics(std::span<const ScoredEstimate> estimates) {
  ErrorStatistics statistics;
  statistics.estimates = static_cast<std::int64_t>(estimates.size());
  if (estimates.empty()) return statistics;
  std::vector<double> sorted;
  double sum = 0;
  for (const ScoredEstimate& estimate : estimates) {
    sorted.push_back(estimate.error_px);
    sum += estimate.error_px;
    statistics.score_curve.add(estimate.score, estimate.error_px);
  }
  std::sort(sorted.begin(), sorted.end());
  const auto count = static_cast<double>(sorted.size());
  statistics.mean_px = sum / count;
  double squares = 0;
  for (const double error_px : sorted) {
    squares += (error_px - statistics.mean_px) * (error_px - statistics.mean_px);
  }
  statistics.std_px = std::sqrt(squares / count);
  statistics.median_px = quantile(sorted, 0.5);
  statistics.p5_px = quantile(sorted, 0.05);
  statistics.p25_px = quantile(sorted, 0.25);
  statistics.p75_px = quantile(sorted, 0.75);
  statistics.p95_px = quantile(sorted, 0.95);
  statistics.max_px = sorted.back();
  statistics.within_2px_percent = percent_within(sorted, 2);
  statistics.within_3p5px_percent = percent_within(sorted, 3.5);
  statistics.within_4px_percent = percent_within(sorted, 4);
  return statistics;
}

}  // namespace puck
