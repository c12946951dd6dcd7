#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "common/io/config.h"
#include "common/table/homography.h"
#include "common/table/table_camera.h"
#include "common/table/table_geometry.h"

namespace puck {

/// A table as one camera sees it.
struct TableCalibration {
  /// Of the plane in which the puck's centre moves, with the camera at home.
  Homography table_from_image;
  TableGeometry geometry;
  std::optional<PinholeCamera> camera;  ///< Needed only where the camera turns.
};

/// Reads the keys of TableGeometry below `table.` from a configuration; those that are not set keep
/// their value.
void read_table_geometry(Config& config, TableGeometry& geometry);

/// Reads [table]: table_from_image = nine numbers, row by row, which must be there, and the keys of
/// TableGeometry, which have defaults; and [camera]: focal_px, principal_x_px, principal_y_px,
/// which must be there together, and pivot_m. Other tables in the file are left alone. Throws
/// ConfigError.
TableCalibration read_table_file(const std::filesystem::path& path);

/// The tables [table] and [camera] as `read_table_file` reads them. `provenance`: where the
/// calibration comes from; becomes a comment.
std::string table_text(const TableCalibration& calibration, std::string_view provenance);

/// Writes that into a file of its own. Throws ConfigError when it cannot be written.
void write_table_file(const std::filesystem::path& path, const TableCalibration& calibration,
                      std::string_view provenance);

}  // namespace puck
