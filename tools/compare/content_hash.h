#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace puck {

/// Hash of contents (FNV-1a, 64 bit), to name results. Not for secrets.
class ContentHash {
 public:
  ContentHash& add(std::string_view bytes);
  /// Throws std::runtime_error when the file cannot be read.
  ContentHash& add_file(const std::filesystem::path& path);

  /// 16 hexadecimal digits.
  std::string text() const;

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace puck
