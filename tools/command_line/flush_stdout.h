#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace puck {

/// Call before reporting success. Throws std::runtime_error when stdout could not be written, as on
/// a full disk.
inline void flush_stdout() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw std::runtime_error(std::string("stdout: cannot be written: ") + std::strerror(errno));
}

}  // namespace puck
