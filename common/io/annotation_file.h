#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "common/vision/geometry/annotation.h"

namespace puck {

/// Reads `t_us,x,y,width,height`, columns in any order, named in the header; `w` and `h` are
/// accepted for width and height. Throws CsvError naming file and line for a missing file or
/// column, a malformed or blank value, a time that is not a whole number, a size below 0.1 px, or
/// no rows. Times may be in any order.
std::vector<Annotation> read_annotation_file(const std::filesystem::path& path);

/// Throws CsvError when the file cannot be written.
void write_annotation_file(const std::filesystem::path& path, std::span<const Annotation> rows);

}  // namespace puck
