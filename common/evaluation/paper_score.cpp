#include "common/evaluation/paper_score.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace puck {
namespace {

constexpr std::int64_t kFarthestUs = 10'000;

}  // namespace

void PaperScore::add(Timestamp tick, const PuckEstimate& estimate) {
  if (estimate.position) positions_.push_back({tick, *estimate.position, estimate.score});
}

std::vector<ScoredEstimate> PaperScore::samples() const {
  std::vector<ScoredEstimate> samples;
  auto nearest = positions_.begin();
  for (const TruthRow& row : truth_.rows()) {
    if (!is_visible(row) || positions_.empty()) continue;
    const auto distance_us = [&](const Position& position) {
      return std::llabs(position.tick - row.time);
    };
    while (nearest + 1 != positions_.end() &&
           distance_us(*(nearest + 1)) <= distance_us(*nearest)) {
      ++nearest;
    }
    if (distance_us(*nearest) > kFarthestUs) continue;
    samples.push_back({nearest->tick, distance_px(nearest->place, row.centre), nearest->score, {}});
  }
  return samples;
}

PaperReport PaperScore::report() const {
  const std::vector<ScoredEstimate> samples = this->samples();
  PaperReport report{error_statistics(samples)};
  report.truth_rows = std::count_if(truth_.rows().begin(), truth_.rows().end(), is_visible);
  if (samples.empty()) return report;
  for (std::size_t limit = 0; limit < PaperReport::kLimits; ++limit) {
    const auto below = std::count_if(samples.begin(), samples.end(), [&](const ScoredEstimate& s) {
      return s.error_px < static_cast<double>(limit);
    });
    report.below_percent[limit] =
        100 * static_cast<double>(below) / static_cast<double>(samples.size());
  }
  return report;
}

}  // namespace puck
