#include "tools/spy/column_layout.h"

#include <algorithm>
#include <numeric>

#include "tools/spy/short_text.h"

namespace puck {
namespace {

constexpr std::size_t kWide = 100;  // From this width on, with wider gaps.

std::size_t wanted_width(const Column& column) {
  std::size_t width = std::max(column.min_width, column.title.size());
  for (const std::string& cell : column.cells) width = std::max(width, plain_text(cell).size());
  return width;
}

/// Width of each column; 0: left out.
std::vector<std::size_t> share_out(const std::vector<Column>& columns, std::size_t gap,
                                   std::size_t width) {
  std::vector<std::size_t> by_importance(columns.size());
  std::iota(by_importance.begin(), by_importance.end(), std::size_t{0});
  std::stable_sort(by_importance.begin(), by_importance.end(), [&](std::size_t a, std::size_t b) {
    return columns[a].importance < columns[b].importance;
  });

  std::vector<std::size_t> widths(columns.size());
  std::size_t room = width + gap;  // The first column has no gap before it.
  for (const std::size_t i : by_importance) {
    const std::size_t least = std::max(columns[i].min_width, columns[i].title.size());
    if (least + gap > room) break;
    widths[i] = least;
    room -= least + gap;
  }
  for (const std::size_t i : by_importance) {
    if (widths[i] == 0) continue;
    const std::size_t more = std::min(room, wanted_width(columns[i]) - widths[i]);
    widths[i] += more;
    room -= more;
  }
  return widths;
}

}  // namespace

std::vector<std::string> lay_out(const std::vector<Column>& columns, std::size_t width) {
  const std::size_t gap = width < kWide ? 1 : 2;
  const std::vector<std::size_t> widths = share_out(columns, gap, width);
  const std::size_t rows = columns.empty() ? 0 : columns.front().cells.size();
  std::vector<std::string> lines(rows + 1);
  for (std::size_t i = 0; i < columns.size(); ++i) {
    if (widths[i] == 0) continue;
    for (std::size_t row = 0; row <= rows; ++row) {
      const std::string& text = row == 0 ? columns[i].title : columns[i].cells[row - 1];
      if (!lines[row].empty()) lines[row].append(gap, ' ');
      lines[row] += columns[i].right ? fit_right(text, widths[i]) : fit_left(text, widths[i]);
    }
  }
  for (std::string& line : lines) line.erase(line.find_last_not_of(' ') + 1);
  return lines;
}

}  // namespace puck
