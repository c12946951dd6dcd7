#pragma once

#include <filesystem>

#include "tools/compare/report.h"

namespace puck {

/// hard.png, covariance.png and score.png, as write_charts says.
void write_all_sets_charts(const ComparisonReport& report, const std::filesystem::path& folder);

}  // namespace puck
