#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "common/table/correspondence.h"

namespace puck {

/// Reads `x_px,y_px,x_m,y_m`, columns in any order, named in the header. Throws CsvError naming
/// file and line for a missing file or column, a malformed value, or no rows.
std::vector<Correspondence> read_correspondence_file(const std::filesystem::path& path);

/// Throws CsvError when the file cannot be written.
void write_correspondence_file(const std::filesystem::path& path,
                               std::span<const Correspondence> rows);

}  // namespace puck
