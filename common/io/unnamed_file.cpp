#include "common/io/unnamed_file.h"

#include <cerrno>
#include <cstring>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "common/io/event_reader.h"

namespace puck {

UnnamedFile::UnnamedFile(std::string_view prefix) : prefix_(prefix) {
  std::error_code error;
  folder_ = std::filesystem::temp_directory_path(error);
  file_ = FileDescriptor(open(folder_.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, S_IRUSR | S_IWUSR));
  if (file_.is_open()) return;
  std::string name = (folder_ / (prefix_ + "XXXXXX")).string();
  file_ = FileDescriptor(mkostemp(name.data(), O_CLOEXEC));
  if (!file_.is_open()) {
    throw EventFileError(name + ": a temporary file cannot be made: " + std::strerror(errno) +
                         "; set TMPDIR to a folder that can be written");
  }
  name_ = name;
}

const std::filesystem::path& UnnamedFile::give_name() {
  constexpr int kMostTries = 1000;
  const std::string own = "/proc/self/fd/" + std::to_string(number());
  for (int i = 0; name_.empty() && i < kMostTries; ++i) {
    const auto name =
        folder_ / (prefix_ + std::to_string(getpid()) + "-" + std::to_string(number() + i));
    if (linkat(AT_FDCWD, own.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) {
      name_ = name;
    } else if (errno != EEXIST) {
      break;
    }
  }
  if (name_.empty()) {
    throw EventFileError(folder_.string() + ": a temporary file cannot be named there: " +
                         std::strerror(errno) + "; set TMPDIR to another folder");
  }
  return name_;
}

std::filesystem::path UnnamedFile::path() {
  drop_name();
  return "/proc/" + std::to_string(getpid()) + "/fd/" + std::to_string(number());
}

void UnnamedFile::drop_name() {
  if (!name_.empty()) unlink(name_.c_str());
  name_.clear();
}

}  // namespace puck
