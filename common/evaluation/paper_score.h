#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common/evaluation/error_statistics.h"
#include "common/evaluation/truth_track.h"
#include "common/vision/puck_estimate.h"

namespace puck {

struct PaperReport : ErrorStatistics {
  static constexpr std::size_t kLimits = 30;

  /// Rows of truth; `estimates` of them have an estimate.
  std::int64_t truth_rows = 0;
  /// Of these estimates, those less than 0, 1 … 29 px off: the paper's curve of valid positions.
  std::array<double, kLimits> below_percent{};
};

/// Scores estimates as the paper's authors' script does: each row of truth takes the nearest
/// estimate of a position, whatever its state, within 10 ms; truth is not interpolated, estimates
/// are not shifted by their latency, and a row without an estimate costs nothing. A row that says
/// of itself that the puck is hidden (less than half of it visible) is left out, since nobody could
/// have marked it.
class PaperScore {
 public:
  explicit PaperScore(TruthTrack truth) : truth_(std::move(truth)) {}

  /// The estimate at a tick. Ticks in the order of their times.
  void add(Timestamp tick, const PuckEstimate& estimate);

  const TruthTrack& truth() const { return truth_; }
  PaperReport report() const;
  /// An estimate for each row of truth that has one.
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
