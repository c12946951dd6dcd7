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

/// A table as one camera sees it.
struct TableCalibration {
  /// Of the plane in which the puck's centre moves, with the camera at home.
  Homography table_from_image;
  TableGeometry geometry;
  std::optional<PinholeCamera> camera;  ///< Needed only where the camera turns.
  /// How the puck glides and bounces there; nothing: never measured.
  std::optional<MotionConstants> motion = std::nullopt;
};

/// Reads the keys of TableGeometry below `table.` from a configuration; those that are not set keep
/// their value.
void read_table_geometry(Config& config, TableGeometry& geometry);

/// Reads [table]: table_from_image = nine numbers, row by row, which must be there, and the keys of
/// TableGeometry, which have defaults; and [camera]: focal_px, principal_x_px, principal_y_px,
/// which must be there together, and pivot_m; and [motion]: the three of MotionConstants, together.
/// Other tables in the file are left alone. Throws
/// ConfigError.
TableCalibration read_table_file(const std::filesystem::path& path);

/// The tables [table], [camera] and [motion] as `read_table_file` reads them. `provenance`: where
/// the calibration comes from; becomes a comment.
std::string table_text(const TableCalibration& calibration, std::string_view provenance);

/// The table [motion] alone.
std::string motion_text(const MotionConstants& motion, std::string_view provenance);

/// Writes table_text into a file of its own. Throws ConfigError when it cannot be written.
void write_table_file(const std::filesystem::path& path, const TableCalibration& calibration,
                      std::string_view provenance);

}  // namespace puck
