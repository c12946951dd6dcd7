#include "tools/compare/text_table.h"

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>

namespace puck {

TextTable::TextTable(std::string title, std::vector<std::string> header)
    : title_(std::move(title)), rows_{std::move(header)} {}

void TextTable::add(std::vector<std::string> row) {
  if (row.size() != rows_.front().size()) {
    throw std::invalid_argument("a row of " + std::to_string(row.size()) + " cells in a table of " +
                                std::to_string(rows_.front().size()) + " columns: " + title_);
  }
  rows_.push_back(std::move(row));
}

std::string TextTable::text() const {
  std::vector<std::size_t> widths(rows_.front().size());
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text = title_ + '\n';
  for (const auto& row : rows_) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - row[i].size(), ' ');
      text += i == 0 ? "  " + row[i] + space : "  " + space + row[i];
    }
    text += '\n';
  }
  return text;
}

std::string TextTable::markdown() const {
  std::string text = "### " + title_ + "\n\n";
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (const std::string& cell : rows_[r]) text += "| " + cell + ' ';
    text += "|\n";
    if (r > 0) continue;
    for (std::size_t i = 0; i < rows_[r].size(); ++i) text += i == 0 ? "|---" : "|---:";
    text += "|\n";
  }
  return text;
}

std::string number_text(std::optional<double> value, int decimals) {
  if (!value) return "-";
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", decimals, *value);
  return text;
}

}  // namespace puck
