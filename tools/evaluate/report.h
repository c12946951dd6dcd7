#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "common/evaluation/accuracy_score.h"
#include "tools/evaluate/replay.h"
#include "tools/evaluate/runs.h"

namespace puck {

/// All that an evaluation found.
struct EvaluationReport {
  std::string algorithm;
  std::optional<std::string> preset;  ///< Of the algorithm puck only.
  RunSummary run;
  std::optional<AccuracyReport> accuracy;  ///< With truth only.
  std::optional<ReplayComparison> replay;  ///< Of a replay only; no keys of it without one.
};

/// A table for people.
void print(const EvaluationReport& report);

/// One flat object; what was not measured is null. Throws std::runtime_error when the file cannot
/// be written.
void write_json(const EvaluationReport& report, const std::filesystem::path& path);

}  // namespace puck
