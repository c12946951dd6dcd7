#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/evaluation/accuracy_score.h"
#include "common/evaluation/paper_score.h"
#include "tools/evaluate/replay.h"
#include "tools/evaluate/runs.h"

namespace puck {

/// All results of an evaluation.
struct EvaluationReport {
  std::string algorithm;
  std::optional<std::string> preset;  ///< For algorithm puck only.
  RunSummary run;
  std::string scoring;                     ///< `ours` or `paper`.
  std::optional<ErrorStatistics> errors;   ///< With truth only.
  std::optional<AccuracyReport> accuracy;  ///< With scoring `ours` only.
  std::optional<PaperReport> paper;        ///< With scoring `paper` only.
  /// With truth and scoring `ours`, or for a recording without a puck.
  std::optional<double> said_and_wrong_percent;
  std::optional<ReplayComparison> replay;  ///< Of a replay only.
};

/// Prints a table.
void print(const EvaluationReport& report);

/// Writes one flat object with null for unmeasured values. Throws std::runtime_error if the file
/// cannot be written.
void write_json(const EvaluationReport& report, const std::filesystem::path& path);

}  // namespace puck
