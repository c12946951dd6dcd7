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

/// Finds the sensor's lag and how the contour's ring lies to the size model's ellipse, and writes
/// the size model's file with a table [contour] added or replaced. `typed`: the command, for a
/// comment. Throws an exception that says which file cannot be used and why.
void calibrate_lag(const LagCommand& command, const std::string& typed);

}  // namespace puck
