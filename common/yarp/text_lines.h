#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace puck {

/// Extracts lines from a byte stream in pieces of any size.
class TextLines {
 public:
  /// Longer lines are refused: the modes of 64 joints take 500 bytes.
  static constexpr std::size_t kMostBytes = 4096;

  void feed(std::span<const std::uint8_t> bytes);

  /// The next complete line without its end, `\n` or `\r\n`. Throws YarpError when it is too long or not text.
  std::optional<std::string> next();

  /// Whether no line, or part of one, is left.
  bool is_empty() const { return text_.empty(); }

 private:
  std::string text_;
};

}  // namespace puck
