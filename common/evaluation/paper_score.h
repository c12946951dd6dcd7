#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common/evaluation/error_statistics.h"
#include "common/evaluation/truth_track.h"
#include "common/vision/interfaces/puck_estimate.h"

namespace puck {

struct PaperReport : ErrorStatistics {
  static constexpr std::size_t kLimits = 30;

  /// Rows of truth; `estimates` of them have an estimate.
  std::int64_t truth_rows = 0;
  /// Share of these estimates less than 0, 1 … 29 px off: the paper's curve of valid positions.
  std::array<double, kLimits> below_percent{};
};

/// Scores estimates as the paper's authors' script does: each row of truth takes the nearest
/// position estimate within 10 ms, in any state. Truth is not interpolated, estimates are not
/// shifted by their latency, and a row without an estimate is not penalised. A row whose `visible`
/// is below half is left out, since a person could not have annotated it.
class PaperScore {
 public:
  explicit PaperScore(TruthTrack truth) : truth_(std::move(truth)) {}

  /// Adds the estimate at a tick. Ticks in the order of their times.
  void add(Timestamp tick, const PuckEstimate& estimate);

  const TruthTrack& truth() const { return truth_; }
  PaperReport report() const;
  /// One estimate for each row of truth that has one.
  std::vector<ScoredEstimate> samples() const;

 private:
  struct Position {
    Timestamp tick;
    Pixel place;
    double score = 0;
  };

  TruthTrack truth_;
  std::vector<Position> positions_;
};

}  // namespace puck
