#pragma once

#include <filesystem>
#include <string>

#include "common/events/sensor_size.h"

namespace puck {

struct SizeCommand {
  std::filesystem::path annotations;
  std::filesystem::path output;
  SensorSize sensor;  ///< {0, 0}: unknown.
};

/// Fits the puck's size to annotations, writes the size model, and prints its residuals. `typed`:
/// the command line, for a comment in the file. Throws CsvError or ConfigError, which name the
/// file, or std::invalid_argument for annotations that determine no size model.
void calibrate_size(const SizeCommand& command, const std::string& typed);

}  // namespace puck
