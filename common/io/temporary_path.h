#pragma once

#include <filesystem>
#include <string_view>

namespace puck {

/// A new empty file in the folder for temporary files (TMPDIR); removed on destruction.
class TemporaryPath {
 public:
  /// Throws EventFileError when it cannot be made.
  explicit TemporaryPath(std::string_view prefix);
  ~TemporaryPath();
  TemporaryPath(const TemporaryPath&) = delete;
  TemporaryPath& operator=(const TemporaryPath&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace puck
