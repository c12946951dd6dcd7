#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "common/vision/geometry/truth_row.h"

namespace puck {

/// Reads `t_us,x,y,width,height[,visible]`, columns in any order, named in the header; `w` and `h`
/// are accepted for width and height. Without a header, reads the boxes of the paper's authors, `t
/// y0 y1 x0 x1` separated by blanks, whose middle is the puck's centre: times are in s if one of
/// them has a decimal point, else in µs. Throws CsvError naming file and line for a missing
/// file or column, a malformed or negative value, no rows, or times that do not increase.
std::vector<TruthRow> read_truth_file(const std::filesystem::path& path);

/// Writes all columns. Throws CsvError when the file cannot be written.
void write_truth_file(const std::filesystem::path& path, std::span<const TruthRow> rows);

}  // namespace puck
