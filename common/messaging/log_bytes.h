#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "common/posix/file_descriptor.h"

namespace puck {

/// A file of any size, seen through a window that moves with what is asked for. One thread.
class LogBytes {
 public:
  /// Throws LogFileError when the file cannot be read.
  explicit LogBytes(const std::filesystem::path& path);
  // peek() points into it.
  LogBytes(const LogBytes&) = delete;
  LogBytes& operator=(const LogBytes&) = delete;

  /// As it was at the start; shorter once the disk fails or the file was cut meanwhile.
  std::int64_t size() const { return size_; }

  /// The bytes at [offset, offset + count), fewer at the end. Valid until the next call.
  std::span<const std::uint8_t> at(std::int64_t offset, std::size_t count);

  /// The same of up to 64 bytes that are far away from what is asked for next: the window stays.
  std::span<const std::uint8_t> peek(std::int64_t offset, std::size_t count);

  /// Where in [from, to) a log's mark begins next; `to` where none does.
  std::int64_t find_mark(std::int64_t from, std::int64_t to);

 private:
  void fill(std::int64_t offset, std::size_t count);

  FileDescriptor file_;
  std::int64_t size_ = 0;
  std::vector<std::uint8_t> window_;
  std::int64_t window_offset_ = 0;
  std::array<std::uint8_t, 64> peeked_{};
};

}  // namespace puck
