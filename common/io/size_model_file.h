#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/vision/geometry/puck_size_model.h"

namespace puck {

/// Reads the table [size_model] with the keys width_0, width_x, width_y, height_0, height_x and
/// height_y, all required; the table [disc], complete or absent; and the optional keys of the table
/// [size_range]: the limits of the size and the sensor's size. Ignores other tables, so that one
/// file can hold a whole calibration. Throws ConfigError.
PuckSizeModel read_size_model_file(const std::filesystem::path& path);

/// The tables [size_model], [disc], if there is one, and [size_range], as `read_size_model_file`
/// reads them. `provenance`: origin of the model; becomes a comment.
std::string size_model_text(const PuckSizeModel& model, std::string_view provenance);

/// Writes size_model_text to a file. Throws ConfigError when it cannot be written.
void write_size_model_file(const std::filesystem::path& path, const PuckSizeModel& model,
                           std::string_view provenance);

}  // namespace puck
