#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "common/vision/truth_row.h"

namespace puck {

/// Reads `t_us,x,y,width,height[,visible]`, columns in any order, told from the header; `w` and `h`
/// are taken for width and height. Or, without a header, the boxes of the paper's authors,
/// `t y0 y1 x0 x1` between blanks, whose middle is the puck's centre: times are in s where one
/// of them has a decimal point, else in µs. Throws CsvError naming file and line for a missing
/// file or column, a malformed or negative value, no rows, or times that do not grow.
std::vector<TruthRow> read_truth_file(const std::filesystem::path& path);

/// Writes all columns. Throws CsvError when the file cannot be written.
void write_truth_file(const std::filesystem::path& path, std::span<const TruthRow> rows);

}  // namespace puck
