#pragma once

#include <filesystem>
#include <string_view>

#include "common/events/pixel_mask.h"

namespace puck {

/// Reads the table [pixel_mask] with the sensor's width and height and the list `pixels`: x, y, x,
/// y, … Throws ConfigError.
PixelMask read_pixel_mask_file(const std::filesystem::path& path);

/// Writes a pixel mask file. `provenance`: origin of the mask; becomes a comment. Throws
/// ConfigError when the file cannot be written.
void write_pixel_mask_file(const std::filesystem::path& path, const PixelMask& mask,
                           std::string_view provenance);

}  // namespace puck
