#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/compare/run_figures.h"

namespace puck {

/// A contestant's results on the sequences of one or several sets.
struct Summary {
  int sequences = 0;
  std::int64_t ticks = 0;  ///< Scored ones; if 0, the figures below are empty.
  // Over all ticks.
  std::optional<double> mean_px;
  std::optional<double> std_px;  ///< Standard deviation of the errors.
  std::optional<double> within_3p5px_percent;
  std::optional<double> within_4px_percent;
  std::optional<double> lost_percent;            ///< Empty by the paper's rules.
  std::optional<double> said_and_wrong_percent;  ///< Empty by the paper's rules.
  std::optional<double> nees_mean;
  std::optional<double> nees_median;  ///< Mean of the sequences' medians.
  std::optional<double> nees_within_95_percent;
  /// Standard errors of mean and lost over the sequences, each with the same weight; empty for a
  /// single sequence.
  std::optional<double> mean_px_standard_error;
  std::optional<double> lost_percent_standard_error;
  // Median and worst of the sequences.
  std::optional<double> median_mean_px;
  std::optional<double> worst_mean_px;
  std::optional<double> longest_loss_ms;
  /// The longest; empty if a sequence has no track at all.
  std::optional<double> time_to_first_track_ms;
  // Over all sequences.
  std::optional<double> cpu_us_per_ms;
  std::optional<double> mev_s;
};

Summary summarise(const std::vector<const RunFigures*>& runs);

/// All results of an experiment.
class Comparison {
 public:
  explicit Comparison(const ExperimentResults& results);

  /// Runs of a contestant on the sets, by seed.
  std::vector<const RunFigures*> runs(const std::vector<std::string>& sets,
                                      const std::string& contestant) const;
  Summary summary(const std::vector<std::string>& sets, const std::string& contestant) const;
  Summary summary(const std::string& set, const std::string& contestant) const;

  const std::vector<RecordingResult>& recordings() const { return recordings_; }
  /// CPU time of the simulation per second of a set; empty without a recording.
  std::optional<double> simulation_cost(const std::string& set) const;

 private:
  std::vector<RunFigures> runs_;
  std::vector<RecordingResult> recordings_;
};

}  // namespace puck
