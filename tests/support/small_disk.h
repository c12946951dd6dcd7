#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

#include <sys/mount.h>

#include "tests/support/temporary_folder.h"

namespace puck {

/// A disk of a few MB in memory that a test can fill. Only root can mount one.
class SmallDisk {
 public:
  explicit SmallDisk(std::int64_t bytes)
      : is_mounted_(mount("puck_test", folder_.path().c_str(), "tmpfs", MS_NOSUID | MS_NODEV,
                          ("size=" + std::to_string(bytes)).c_str()) == 0) {}
  ~SmallDisk() {
    if (is_mounted_) umount2(folder_.path().c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  bool is_mounted() const { return is_mounted_; }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  std::int64_t free_bytes() const {
    return static_cast<std::int64_t>(std::filesystem::space(folder_.path()).available);
  }

 private:
  TemporaryFolder folder_;
  bool is_mounted_;
};

}  // namespace puck
