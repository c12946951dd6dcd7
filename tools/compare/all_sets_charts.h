#pragma once

#include <filesystem>

#include "tools/compare/report.h"

namespace puck {

/// Writes hard.png, covariance.png and score.png; see write_charts.
void write_all_sets_charts(const ComparisonReport& report, const std::filesystem::path& folder);

}  // namespace puck
