#pragma once

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <stdexcept>
#include <string>

namespace puck {

/// For a program that is about to say that all is well. Throws std::runtime_error when what it
/// printed did not get out, as on a full disk.
inline void flush_stdout() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw std::runtime_error(std::string("stdout: cannot be written: ") + std::strerror(errno));
}

}  // namespace puck
