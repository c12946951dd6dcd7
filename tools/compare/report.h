#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/compare/goals.h"
#include "tools/compare/sequence_plan.h"
#include "tools/compare/summary.h"
#include "tools/compare/text_table.h"

namespace puck {

/// All that a comparison is told from.
struct ComparisonReport {
  PlanOptions options;
  std::vector<std::string> ingredients;  ///< Of the preset `default`.
  const Comparison& comparison;
  const Comparison& latency;
};

/// Which seeds are which, one line each.
std::string seeds_text(const PlanOptions& options);

/// Figures to reach; each set's table; the hard ones at a glance; ablation; latency; simulation.
std::vector<TextTable> report_tables(const ComparisonReport& report);

/// comparison.txt, comparison.md and comparison.json. Throws std::runtime_error when one cannot be
/// written.
void write_report(const ComparisonReport& report, const std::filesystem::path& folder);

}  // namespace puck
