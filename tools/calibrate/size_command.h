#pragma once

#include <filesystem>
#include <string>

#include "common/events/sensor_size.h"

namespace puck {

struct SizeCommand {
  std::filesystem::path annotations;
  std::filesystem::path output;
  SensorSize sensor;  ///< {0, 0}: not known.
};

/// Fits the puck's size to annotations, writes the size model, and prints how good it is. `typed`:
/// the command, for a comment. Throws CsvError or ConfigError, which name the file, or
/// std::invalid_argument for annotations that fix no size.
void calibrate_size(const SizeCommand& command, const std::string& typed);

}  // namespace puck
