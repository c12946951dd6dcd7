#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>

#include "common/events/sensor_size.h"

namespace puck {

struct TableCommand {
  std::filesystem::path correspondences;
  std::filesystem::path output;
  SensorSize sensor;  ///< {0, 0}: not known. Its middle is the principal point, if none is told.
  std::optional<std::array<double, 2>> principal_point;
  std::optional<double> focal_px;  ///< Nothing: fitted, where the principal point is known.
  double puck_height_m = 0;        ///< The puck's thickness, if the correspondences lie below it.
  std::array<double, 3> pivot_m{};
};

/// Fits the homography from the image to the table, and the camera where it is to be known, writes
/// them, and prints how good they are. `typed`: the command, for a comment. Throws CsvError or
/// ConfigError, which name the file, or std::invalid_argument for correspondences that fix no
/// homography or no camera.
void calibrate_table(const TableCommand& command, const std::string& typed);

}  // namespace puck
