#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/vision/puck_size_model.h"

namespace puck {

/// Reads the table [size_model] with the keys width_0, width_x, width_y, height_0, height_x and
/// height_y, all of which must be there; the table [disc], whole or not at all; and what there is
/// of the table [size_range]: the limits of the size and the sensor's size. Other tables in the
/// file are left alone, so that one file can hold a whole calibration. Throws ConfigError.
PuckSizeModel read_size_model_file(const std::filesystem::path& path);

/// The tables [size_model], [disc], if there is one, and [size_range] as `read_size_model_file`
/// reads it. `provenance`: where the model comes from; becomes a comment.
std::string size_model_text(const PuckSizeModel& model, std::string_view provenance);

/// Writes that into a file of its own. Throws ConfigError when it cannot be written.
void write_size_model_file(const std::filesystem::path& path, const PuckSizeModel& model,
                           std::string_view provenance);

}  // namespace puck
