#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "common/posix/file_descriptor.h"

namespace puck {

/// A new empty file in the folder for temporary files (TMPDIR). It has no name except while it is
/// asked for, so nothing of it stays when a signal ends the process. Where the folder's file system
/// cannot do that, it has its name from the beginning until `drop_name`.
class UnnamedFile {
 public:
  /// Throws EventFileError when it cannot be made.
  explicit UnnamedFile(std::string_view prefix);
  ~UnnamedFile() { drop_name(); }
  UnnamedFile(const UnnamedFile&) = delete;
  UnnamedFile& operator=(const UnnamedFile&) = delete;

  int number() const { return file_.number(); }

  /// By this path the process and its children can open it, as long as this object lives. Removes
  /// its name, if it has one.
  std::filesystem::path path();

  /// For libraries that want a file with a name. Throws EventFileError.
  const std::filesystem::path& give_name();
  void drop_name();

 private:
  std::filesystem::path folder_;
  std::string prefix_;
  FileDescriptor file_;
  std::filesystem::path name_;  // Empty: none.
};

}  // namespace puck
