#pragma once

#include <filesystem>
#include <span>

#include "common/evaluation/error_statistics.h"

namespace puck {

/// Writes into a folder: within.csv (limit_px,percent), the share of the ticks within each error,
/// and score.csv (threshold,believed,right,precision,recall), precision and recall by threshold on
/// the score. At least one estimate. Throws std::runtime_error on failure.
void write_curves(std::span<const ScoredEstimate> estimates, const std::filesystem::path& folder);

/// The same with error.csv (t_us,error_px), the error over time, and a chart of each: error.png,
/// within.png and score.png.
void write_plots(std::span<const ScoredEstimate> estimates, const std::filesystem::path& folder);

}  // namespace puck
