#pragma once

#include <charconv>
#include <string_view>
#include <system_error>

namespace puck {

/// Parses all of `text` as one number; false if it is not one.
template <typename Number>
bool parse_number(std::string_view text, Number& value) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc{} && result.ptr == text.data() + text.size();
}

}  // namespace puck
