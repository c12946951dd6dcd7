#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace puck {

/// A buffered file that reports a full disk or a missing folder.
class OutputFile {
 public:
  /// Throws EventFileError when it cannot be opened.
  explicit OutputFile(const std::filesystem::path& path);

  void append(std::string_view bytes) {
    buffer_.append(bytes);
    if (buffer_.size() >= kFlushBytes) flush();
  }
  /// Throws EventFileError when it cannot be written.
  void flush();

 private:
  static constexpr std::size_t kFlushBytes = 65536;

  std::string name_;
  std::ofstream file_;
  std::string buffer_;
};

}  // namespace puck
