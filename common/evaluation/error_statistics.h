#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "common/evaluation/score_curve.h"
#include "common/events/timestamp.h"

namespace puck {

/// An estimate that counts, and its error.
struct ScoredEstimate {
  Timestamp tick;
  double error_px = 0;
  double score = 0;
  std::optional<double> nees;  ///< As normalised_error_squared says.
};

/// Statistics of the errors of all estimates that count. Percentages are of these estimates.
struct ErrorStatistics {
  std::int64_t estimates = 0;  ///< If 0, the other values are undefined.
  double mean_px = 0;
  double std_px = 0;  ///< Standard deviation of the errors around their mean.
  double median_px = 0;
  double p5_px = 0;
  double p25_px = 0;
  double p75_px = 0;
  double p95_px = 0;
  double max_px = 0;
  double within_2px_percent = 0;
  double within_3p5px_percent = 0;
  double within_4px_percent = 0;
  ScoreCurve score_curve;
};

ErrorStatistics error_statistics(std::span<const ScoredEstimate> estimates);

}  // namespace puck
