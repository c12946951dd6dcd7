#pragma once

#include <filesystem>
#include <string>

namespace puck {

/// Fits the homography from the image to the table, writes it, and prints how good it is. `typed`:
/// the command, for a comment. Throws CsvError or ConfigError, which name the file, or
/// std::invalid_argument for correspondences that fix no homography.
void calibrate_table(const std::filesystem::path& correspondences,
                     const std::filesystem::path& output, const std::string& typed);

}  // namespace puck
