#pragma once

#include <filesystem>
#include <string>

#include "common/io/event_reader.h"

namespace puck {

struct HotPixelsCommand {
  std::filesystem::path recording;
  std::filesystem::path output;
  EventFileOptions file;
};

/// Finds the pixels of a recording that fire all the time, writes a mask of them, and prints the
/// worst. `typed`: the command, for a comment. Throws an exception that says which file cannot be
/// used and why.
void calibrate_hot_pixels(const HotPixelsCommand& command, const std::string& typed);

}  // namespace puck
