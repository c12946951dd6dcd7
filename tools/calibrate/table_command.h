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
  SensorSize sensor;  ///< {0, 0}: unknown. Its centre is the default principal point.
  std::optional<std::array<double, 2>> principal_point;
  std::optional<double> focal_px;  ///< Empty: fitted, if the principal point is known.
  double puck_height_m = 0;        ///< The puck's thickness, if the correspondences lie below it.
  std::array<double, 3> pivot_m{};
};

/// Fits the homography from the image to the table and, if asked for, the camera, writes them, and
/// prints the residuals. `typed`: the command line, for a comment in the file. Throws CsvError or
/// ConfigError, which name the file, or std::invalid_argument for correspondences that determine no
/// homography or no camera.
void calibrate_table(const TableCommand& command, const std::string& typed);

}  // namespace puck
