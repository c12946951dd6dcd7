#pragma once

#include <filesystem>

#include "tools/play/save_figures.h"

namespace puck {

/// What the TRUTH and the GAME in a log say of the game that was played in real time. Throws
/// LogFileError when there is no such log, std::runtime_error when it has no truth.
SaveFigures figures_of_log(const std::filesystem::path& path);

}  // namespace puck
