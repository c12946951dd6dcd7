#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

#include "common/io/word_assembler.h"
#include "common/posix/file_descriptor.h"

namespace puck {

/// A buffered file that reports a full disk or a missing folder.
class OutputFile {
 public:
  /// "-" is standard output. Throws EventFileError when it cannot be opened.
  explicit OutputFile(const std::filesystem::path& path);

  void append(std::string_view bytes) {
    buffer_.append(bytes);
    if (buffer_.size() >= kFlushBytes) flush();
  }
  /// A number, little-endian.
  template <typename Word>
  void append_word(Word word) {
    std::array<std::byte, sizeof(Word)> bytes{};
    store_word(word, bytes.data());
    append({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
  /// Throws EventFileError when it cannot be written.
  void flush();

 private:
  static constexpr std::size_t kFlushBytes = 65536;

  std::string name_;
  FileDescriptor file_;
  std::string buffer_;
};

/// Copies a file to standard output. Throws EventFileError.
void copy_to_stdout(const std::filesystem::path& path);

}  // namespace puck
