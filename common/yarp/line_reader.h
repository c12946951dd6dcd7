#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace puck {

/// Cuts lines out of bytes that come in any pieces.
class LineReader {
 public:
  /// A longer line is refused: the modes of 64 joints take 500 bytes.
  static constexpr std::size_t kMostBytes = 4096;

  void feed(std::span<const std::uint8_t> bytes);

  /// The next whole line without its `\n` or `\r\n`. Throws BoardError when it is too long, or no
  /// text.
  std::optional<std::string> next();

  /// Lines, or their beginning, that nobody has asked for.
  bool is_empty() const { return text_.empty(); }

 private:
  std::string text_;
};

}  // namespace puck
