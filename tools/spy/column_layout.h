#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace puck {

/// A table column of variable width.
struct Column {
  std::string title;
  bool right = false;         ///< Aligned right, for numbers.
  int importance = 0;         ///< The columns with the highest value are left out first.
  std::size_t min_width = 0;  ///< Minimum width, so that small changes do not shift the columns.
  std::vector<std::string> cells{};
};

/// The head and the rows, each `width` characters at most. Columns that do not fit at their minimum
/// width are left out, the least important first; remaining space goes to the most important
/// columns. All columns have the same number of cells.
std::vector<std::string> lay_out(const std::vector<Column>& columns, std::size_t width);

}  // namespace puck
