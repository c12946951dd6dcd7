#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace puck {

/// One setting as written.
struct ConfigEntry {
  /// monostate: a type that no key accepts.
  std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>> value;
  std::string text;   ///< As written, in one line, for messages.
  std::string where;  ///< `file:line` or `--set assignment`.
  bool is_empty_table = false;
};

}  // namespace puck
