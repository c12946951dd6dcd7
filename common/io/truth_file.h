#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "common/vision/truth_row.h"

namespace puck {

/// Reads `t_us,x,y,width,height[,visible]`, columns in any order, told from the header; `w` and `h`
/// are taken for width and height. Throws CsvError naming file and line for a missing file or
/// column, a malformed or negative value, no rows, or times that do not grow.
std::vector<TruthRow> read_truth_file(const std::filesystem::path& path);

/// Writes all columns. Throws CsvError when the file cannot be written.
void write_truth_file(const std::filesystem::path& path, std::span<const TruthRow> rows);

}  // namespace puck
