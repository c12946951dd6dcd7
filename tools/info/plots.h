#pragma once

#include <filesystem>

#include "tools/info/survey.h"

namespace puck {

/// Draws rate.png and pixels.png into the folder, which is made if needed, with python3-matplotlib.
/// Throws std::runtime_error with the remedy.
void draw_survey(const Survey& survey, const std::filesystem::path& folder);

}  // namespace puck
