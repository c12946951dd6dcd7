#pragma once

#include <filesystem>

#include "tools/play/sweep.h"

namespace puck {

/// Writes saves_NAME.png into a folder, which is made if need be: the save rate of each curve with
/// its 95 % interval, and between what they must lie. Throws std::runtime_error when that fails.
void write_plot(const Sweep& sweep, const std::filesystem::path& folder);

}  // namespace puck
