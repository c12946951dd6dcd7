#pragma once

#include <filesystem>
#include <string>

#include "common/io/event_reader.h"

namespace puck {

struct LagCommand {
  std::filesystem::path recording;
  std::filesystem::path truth;
  std::filesystem::path size_model;
  std::filesystem::path output;  ///< May be `size_model` itself.
  EventFileOptions file;
};

/// Fits the sensor's lag and the offset of the contour's ring from the size model's ellipse, and
/// writes the size model's file with a table [contour] added or replaced. `typed`: the command
/// line, for a comment in the file. Throws an exception that names the unusable file and the
/// reason.
void calibrate_lag(const LagCommand& command, const std::string& typed);

}  // namespace puck
