#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace puck {

/// One column of a table that may have to do with less room than it wants.
struct Column {
  std::string title;
  bool right = false;  ///< Numbers stand to the right.
  int importance = 0;  ///< Where room is short, columns of the highest go first.
  std::size_t min_width =
      0;  ///< It takes so much in any case, so that little changes move nothing.
  std::vector<std::string> cells{};
};

/// The head and the rows, each `width` characters at most. Columns that do not fit even at their
/// least width are left out, the least important first; room that is left goes to the most
/// important that want it. All have the same number of cells.
std::vector<std::string> lay_out(const std::vector<Column>& columns, std::size_t width);

}  // namespace puck
