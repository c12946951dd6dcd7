#pragma once

#include <filesystem>

#include "tools/compare/summary.h"

namespace puck {

/// trajectories-SET.png for each recording that is shown: x and y over time, and in the image, of
/// all contestants and of truth. Throws std::runtime_error when one cannot be written.
void write_trajectories(const Comparison& comparison, const std::filesystem::path& folder);

}  // namespace puck
