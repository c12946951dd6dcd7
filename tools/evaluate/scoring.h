#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/evaluation/accuracy_score.h"
#include "common/evaluation/paper_score.h"
#include "common/events/sensor_size.h"
#include "tools/evaluate/options.h"
#include "tools/evaluate/report.h"
#include "tools/evaluate/runs.h"

namespace puck {

/// Scores the ticks of a run: by our rules or the paper's, at every tick or at the rows of the
/// truth alone; or, for a recording without a puck, counts false tracks.
class Scoring {
 public:
  /// Without truth nothing is scored, except with --no-puck.
  Scoring(const EvaluateOptions& options, std::vector<TruthRow> truth, SensorSize sensor);

  /// Null without truth.
  const TruthTrack* truth() const {
    return ours_ ? &ours_->truth() : paper_ ? &paper_->truth() : nullptr;
  }
  /// Times of additional queries.
  const std::vector<Timestamp>& marks() const { return marks_; }

  /// Ticks in order of time.
  void add(const EvaluatedTick& tick);

  void write_to(EvaluationReport& report) const;
  /// The scored estimates, for plots.
  std::vector<ScoredEstimate> samples() const;
  /// Warnings for reading the figures of a report that write_to has filled: truth that does not
  /// cover the events, or has gaps, or no scored ticks. Less than 100 ms at the ends is ignored.
  std::vector<std::string> warnings(const EvaluationReport& report) const;
  /// Whether truth and events have no time in common, so that they cannot belong together.
  bool is_of_another_time(const RunSummary& run) const;

 private:
  std::int64_t longest_gap_us() const;

  bool at_marks_alone_;
  std::vector<Timestamp> marks_;
  std::optional<AccuracyScore> ours_;
  std::optional<PaperScore> paper_;
  bool no_puck_;
  std::int64_t ticks_ = 0;
  std::int64_t tracking_ = 0;
};

}  // namespace puck
