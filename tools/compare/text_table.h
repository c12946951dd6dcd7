#pragma once

#include <optional>
#include <string>
#include <vector>

namespace puck {

/// A table of text, the first column aligned left, the others right.
class TextTable {
 public:
  TextTable(std::string title, std::vector<std::string> header);

  /// `row` must have as many cells as the header; throws std::invalid_argument otherwise.
  void add(std::vector<std::string> row);

  /// Aligned with spaces, for a terminal.
  std::string text() const;
  std::string markdown() const;

 private:
  std::string title_;
  std::vector<std::vector<std::string>> rows_;  // the header first
};

/// With a fixed number of decimals; a dash for an empty value.
std::string number_text(std::optional<double> value, int decimals);

}  // namespace puck
