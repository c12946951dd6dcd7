#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "common/vision/contour/contour_calibration.h"

namespace puck {

/// Reads the table [contour] with the keys lag_us, wall_share, grow_px, trail_px and lean_deg, each
/// with a default. `std::nullopt` when the file has none of them. Ignores other tables. Throws
/// ConfigError when the file is missing or not TOML, or a value is not a number or out of range.
std::optional<ContourCalibration> read_contour_calibration(const std::filesystem::path& path);

/// The table [contour] as `read_contour_calibration` reads it. `provenance`: where the values come
/// from; becomes a comment.
std::string contour_calibration_text(const ContourCalibration& calibration,
                                     std::string_view provenance);

}  // namespace puck
