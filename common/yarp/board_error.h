#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace puck {

/// A control board, or the name server, did not do what it should: one line that says what, and to
/// what it was asked. What it sent is quoted with `?` for what would steer a terminal.
class BoardError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// In double quotes and harmless, shortened if it is long.
std::string in_quotes(std::string_view text);

}  // namespace puck
