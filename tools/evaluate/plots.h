#pragma once

#include <filesystem>
#include <span>

#include "common/evaluation/error_statistics.h"

namespace puck {

/// Writes into a folder, which is made if need be: error.png, the error over time; within.png and
/// within.csv (limit_px,percent), the share of the ticks within each error; score.png and score.csv
/// (threshold,believed,right,precision,recall), what believing only scores from a threshold on
/// gives. Throws std::runtime_error when that fails or there are no estimates.
void write_plots(std::span<const ScoredEstimate> estimates, const std::filesystem::path& folder);

}  // namespace puck
