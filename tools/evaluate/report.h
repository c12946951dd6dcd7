#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/evaluation/accuracy_score.h"
#include "common/evaluation/paper_score.h"
#include "tools/evaluate/replay.h"
#include "tools/evaluate/runs.h"

namespace puck {

/// All that an evaluation found.
struct EvaluationReport {
  std::string algorithm;
  std::optional<std::string> preset;  ///< Of the algorithm puck only.
  RunSummary run;
  std::string scoring;                     ///< `ours` or `paper`.
  std::optional<ErrorStatistics> errors;   ///< With truth only: by our rules or the paper's.
  std::optional<AccuracyReport> accuracy;  ///< By our rules only.
  std::optional<PaperReport> paper;        ///< By the paper's rules only.
  /// With truth, by our rules, or of a recording without a puck.
  std::optional<double> said_and_wrong_percent;
  std::optional<ReplayComparison> replay;  ///< Of a replay only; no keys of it without one.
};

/// A table for people.
void print(const EvaluationReport& report);

/// One flat object; what was not measured is null. Throws std::runtime_error when the file cannot
/// be written.
void write_json(const EvaluationReport& report, const std::filesystem::path& path);

}  // namespace puck
