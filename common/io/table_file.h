#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "common/io/config.h"
#include "common/table/homography.h"
#include "common/table/motion_constants.h"
#include "common/table/table_camera.h"
#include "common/table/table_geometry.h"

namespace puck {

/// The calibration of a table for one camera.
struct TableCalibration {
  /// For the plane in which the puck's centre moves, with the camera at home.
  Homography table_from_image;
  TableGeometry geometry;
  std::optional<PinholeCamera> camera;  ///< Needed only for a camera that turns.
  /// How the puck glides and bounces; `std::nullopt`: not measured.
  std::optional<MotionConstants> motion = std::nullopt;
};

/// Reads the keys of TableGeometry under `table.`; keys that are not set keep their value.
void read_table_geometry(Config& config, TableGeometry& geometry);

/// Reads [table]: table_from_image = nine numbers, row-major, required, and the keys of
/// TableGeometry, which have defaults; [camera]: focal_px, principal_x_px, principal_y_px, all or
/// none, and pivot_m; and [motion]: the three keys of MotionConstants, all or none. Ignores other
/// tables. Throws ConfigError.
TableCalibration read_table_file(const std::filesystem::path& path);

/// The tables [table], [camera] and [motion], as `read_table_file` reads them. `provenance`: origin
/// of the calibration; becomes a comment.
std::string table_text(const TableCalibration& calibration, std::string_view provenance);

/// Only the table [motion].
std::string motion_text(const MotionConstants& motion, std::string_view provenance);

/// Writes table_text to a file. Throws ConfigError when it cannot be written.
void write_table_file(const std::filesystem::path& path, const TableCalibration& calibration,
                      std::string_view provenance);

}  // namespace puck
