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

/// Finds the hot pixels of a recording, writes a mask of them, and prints the worst. `typed`: the
/// command line, for a comment in the file. Throws an exception that names the unusable file and
/// the reason.
void calibrate_hot_pixels(const HotPixelsCommand& command, const std::string& typed);

}  // namespace puck
