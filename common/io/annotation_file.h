#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "common/events/timestamp.h"
#include "common/vision/pixel.h"

namespace puck {

/// A puck as a person, or the simulator in a person's place, marked it.
struct Annotation {
  Timestamp time;
  Pixel centre;
  PuckSize size;
};

/// Reads `t_us,x,y,width,height`, columns in any order, told from the header; `w` and `h` are taken
/// for width and height. Throws CsvError naming file and line for a missing file or column, a
/// malformed value, a size below 0.1 px, or no rows. Times may be in any order.
std::vector<Annotation> read_annotation_file(const std::filesystem::path& path);

/// Throws CsvError when the file cannot be written.
void write_annotation_file(const std::filesystem::path& path, std::span<const Annotation> rows);

}  // namespace puck
