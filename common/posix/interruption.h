#pragma once

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>

#include <sys/eventfd.h>
#include <unistd.h>

#include "common/posix/file_descriptor.h"

namespace puck {

/// Ends the waits of another thread. Safe from any thread.
class Interruption {
 public:
  /// Throws std::runtime_error when the system has no descriptor left.
  Interruption() : event_(eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)) {
    if (!event_.is_open())
      throw std::runtime_error(std::string("eventfd: ") + std::strerror(errno));
  }

  /// Ends all present and later waits.
  void request() {
    const std::uint64_t one = 1;
    // It can only fail where it was requested before.
    static_cast<void>(!write(event_.number(), &one, sizeof one));
  }

  /// Readable, for poll(), once it is requested.
  int number() const { return event_.number(); }

 private:
  FileDescriptor event_;
};

}  // namespace puck
