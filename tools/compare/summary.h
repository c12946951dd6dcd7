#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/compare/run_figures.h"

namespace puck {

/// How one contestant did on all the sequences of a set, or of several.
struct Summary {
  int sequences = 0;
  std::int64_t ticks = 0;  ///< That count; without any, nothing of the next lines is known.
  // Over all ticks.
  std::optional<double> mean_px;
  std::optional<double> std_px;  ///< Of the errors from that mean.
  std::optional<double> within_3p5px_percent;
  std::optional<double> within_4px_percent;
  std::optional<double> lost_percent;            ///< Nothing by the paper's rules.
  std::optional<double> said_and_wrong_percent;  ///< Nothing by the paper's rules.
  std::optional<double> nees_mean;
  std::optional<double> nees_median;  ///< Mean of the sequences' medians.
  std::optional<double> nees_within_95_percent;
  /// How far mean and lost may be off since the sequences are few: the standard error of a mean in
  /// which each sequence counts as much, not each tick. Nothing for a single one.
  std::optional<double> mean_px_standard_error;
  std::optional<double> lost_percent_standard_error;
  // The middle one and the worst of the sequences.
  std::optional<double> median_mean_px;
  std::optional<double> worst_mean_px;
  std::optional<double> longest_loss_ms;
  /// The longest of them; nothing when in one the puck was never tracked.
  std::optional<double> time_to_first_track_ms;
  // Over all sequences.
  std::optional<double> cpu_us_per_ms;
  std::optional<double> mev_s;
};

Summary summarise(const std::vector<const RunFigures*>& runs);

/// All that has been run, to be looked up.
class Comparison {
 public:
  explicit Comparison(const ExperimentResults& results);

  /// Runs of a contestant on the sets; in the order of their seeds.
  std::vector<const RunFigures*> runs(const std::vector<std::string>& sets,
                                      const std::string& contestant) const;
  Summary summary(const std::vector<std::string>& sets, const std::string& contestant) const;
  Summary summary(const std::string& set, const std::string& contestant) const;

  const std::vector<RecordingResult>& recordings() const { return recordings_; }
  /// CPU time of the simulation for each second of a set; nothing where it has no recording.
  std::optional<double> simulation_cost(const std::string& set) const;

 private:
  std::vector<RunFigures> runs_;
  std::vector<RecordingResult> recordings_;
};

}  // namespace puck
