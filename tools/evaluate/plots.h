#pragma once

#include <filesystem>

#include "common/evaluation/accuracy_score.h"

namespace puck {

/// Writes error.png (error over time) and within.png (share of the ticks within each error) into a
/// folder, which is made if need be. Throws std::runtime_error when that fails.
void write_plots(const AccuracyScore& score, const std::filesystem::path& folder);

}  // namespace puck
