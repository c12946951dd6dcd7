#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <sys/mman.h>
#include <unistd.h>

#include "common/posix/file_descriptor.h"

namespace puck {

/// A file in memory, for readers that need a path. Rewritten for every input.
class MemoryFile {
 public:
  MemoryFile() : memory_(memfd_create("fuzz", MFD_CLOEXEC)) {
    if (!memory_.is_open()) std::abort();
    path_ = "/proc/self/fd/" + std::to_string(memory_.number());
  }

  const std::filesystem::path& write(const std::uint8_t* data, std::size_t size) {
    if (ftruncate(memory_.number(), 0) != 0 ||
        pwrite(memory_.number(), data, size, 0) != static_cast<ssize_t>(size)) {
      std::abort();
    }
    return path_;
  }

 private:
  FileDescriptor memory_;
  std::filesystem::path path_;
};

}  // namespace puck
