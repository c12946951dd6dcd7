#pragma once

#include <filesystem>

#include "tools/play/save_figures.h"

namespace puck {

/// The result of a game played in real time, from TRUTH and GAME in its log. Throws LogFileError if
/// the log is missing, std::runtime_error if it has no truth.
SaveFigures figures_of_log(const std::filesystem::path& path);

}  // namespace puck
