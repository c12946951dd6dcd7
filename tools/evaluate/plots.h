#pragma once

#include <filesystem>
#include <span>

#include "common/evaluation/error_statistics.h"

namespace puck {

/// Writes into a folder, created if needed: error.png, the error over time; within.png and
/// within.csv (limit_px,percent), the share of the ticks within each error; score.png and score.csv
/// (threshold,believed,right,precision,recall), precision and recall by threshold on the score.
/// Throws std::runtime_error on failure or without estimates.
void write_plots(std::span<const ScoredEstimate> estimates, const std::filesystem::path& folder);

}  // namespace puck
