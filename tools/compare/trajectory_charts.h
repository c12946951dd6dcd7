#pragma once

#include <filesystem>

#include "tools/compare/summary.h"

namespace puck {

/// Writes trajectories-SET.png for each shown recording: x and y over time, and in the image, of
/// all contestants and the truth. Throws std::runtime_error when one cannot be written.
void write_trajectories(const Comparison& comparison, const std::filesystem::path& folder);

}  // namespace puck
