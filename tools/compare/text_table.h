#pragma once

#include <optional>
#include <string>
#include <vector>

namespace puck {

/// A table of words, the first column to the left and all others to the right.
class TextTable {
 public:
  TextTable(std::string title, std::vector<std::string> header);

  /// As many cells as the header has; throws std::invalid_argument otherwise.
  void add(std::vector<std::string> row);

  /// With spaces, for a terminal.
  std::string text() const;
  std::string markdown() const;

 private:
  std::string title_;
  std::vector<std::vector<std::string>> rows_;  // the header first
};

/// Fixed decimals; a dash for nothing.
std::string number_text(std::optional<double> value, int decimals);

}  // namespace puck
