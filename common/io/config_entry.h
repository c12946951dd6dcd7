#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace puck {

/// One setting as it was written.
struct ConfigEntry {
  /// monostate: of a type that no key has.
  std::variant<std::monostate, bool, std::int64_t, double, std::string, std::vector<double>> value;
  std::string text;   ///< As it was written, in one line, for messages.
  std::string where;  ///< `file:line` or `--set assignment`.
  bool is_empty_table = false;
};

}  // namespace puck
