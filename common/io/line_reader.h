#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "common/io/byte_source.h"

namespace puck {

/// The lines of a source.
class LineReader {
 public:
  /// Skips lines longer than `longest`. The source must outlive the reader.
  LineReader(ByteSource& bytes, std::size_t longest);

  /// The next line, without its end, until the next call; nothing at the end of the source. Throws
  /// EventFileError.
  std::optional<std::string_view> next();

  /// Whether the line was ended by a line end, not by the end of the source.
  bool is_whole() const { return is_whole_; }
  /// Number of lines skipped since the last call.
  std::int64_t take_skipped() { return std::exchange(skipped_, 0); }
  /// Length of what was read.
  std::int64_t bytes() const { return bytes_before_ + static_cast<std::int64_t>(used_); }

  /// After the source has been rewound.
  void restart();

 private:
  bool refill();

  ByteSource& source_;
  std::size_t longest_;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
  std::size_t size_ = 0;
  std::int64_t bytes_before_ = 0;  // Before the buffer.
  bool is_whole_ = true;
  bool is_in_skipped_ = false;
  std::int64_t skipped_ = 0;
};

}  // namespace puck
