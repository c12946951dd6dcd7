#pragma once

#include <array>
#include <filesystem>
#include <stdexcept>
#include <string>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/support/temporary_folder.h"

namespace puck {

/// A full pipe without a reader: a blocking write to it hangs. Also available under a path, for a
/// program's output. Its end makes hanging writers fail.
class StuckPipe {
 public:
  StuckPipe() {
    if (mkfifo(path().c_str(), 0600) != 0) throw std::runtime_error("no pipe");
    reader_ = open(path().c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    descriptor_ = open(path().c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
    if (reader_ < 0 || descriptor_ < 0) throw std::runtime_error("no pipe");
    const std::array<char, 4096> page{};
    while (write(descriptor_, page.data(), page.size()) > 0) continue;
    if (fcntl(descriptor_, F_SETFL, 0) != 0) throw std::runtime_error("no pipe that blocks");
  }
  // The writing end stays open, since a writer may hang in it.
  ~StuckPipe() { close(reader_); }
  StuckPipe(const StuckPipe&) = delete;
  StuckPipe& operator=(const StuckPipe&) = delete;

  std::filesystem::path path() const { return folder_ / "pipe"; }
  /// The writing end.
  int descriptor() const { return descriptor_; }

 private:
  TemporaryFolder folder_;
  int reader_ = -1;
  int descriptor_ = -1;
};

}  // namespace puck
