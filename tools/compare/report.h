#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/compare/goals.h"
#include "tools/compare/sequence_plan.h"
#include "tools/compare/summary.h"
#include "tools/compare/text_table.h"

namespace puck {

/// The data of a report.
struct ComparisonReport {
  PlanOptions options;
  const Comparison& comparison;
  const Comparison& latency;
};

/// The seeds of each set, one line each.
std::string seeds_text(const PlanOptions& options);

/// Goals; a table for each set; all sets at a glance; latency; simulation.
std::vector<TextTable> report_tables(const ComparisonReport& report);

/// comparison.txt, comparison.md and comparison.json. Throws std::runtime_error when one cannot be
/// written.
void write_report(const ComparisonReport& report, const std::filesystem::path& folder);

}  // namespace puck
