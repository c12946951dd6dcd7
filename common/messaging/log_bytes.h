#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "common/posix/file_descriptor.h"

namespace puck {

/// A file of any size, read through a window in memory. One thread.
class LogBytes {
 public:
  /// Throws LogFileError when the file cannot be read.
  explicit LogBytes(const std::filesystem::path& path);
  // peek() returns a view of it.
  LogBytes(const LogBytes&) = delete;
  LogBytes& operator=(const LogBytes&) = delete;

  /// Size at the start, or less after a read error or if the file was cut.
  std::int64_t size() const { return size_; }

  /// The bytes at [offset, offset + count), fewer at the end. Valid until the next call.
  std::span<const std::uint8_t> at(std::int64_t offset, std::size_t count);

  /// As at(), for up to 64 bytes far away from the next reads: the window does not move.
  std::span<const std::uint8_t> peek(std::int64_t offset, std::size_t count);

  /// Position of the next log mark in [from, to); `to` without one.
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
