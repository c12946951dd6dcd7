#pragma once

#include <sys/socket.h>
#include <unistd.h>

namespace puck {

/// A socket, closed in the end.
class Socket {
 public:
  /// As socket() takes them. Without success fd() is below 0, and errno says why.
  Socket(int domain, int type, int protocol) : fd_(socket(domain, type | SOCK_CLOEXEC, protocol)) {}
  ~Socket() {
    if (fd_ >= 0) close(fd_);
  }
  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;

  int fd() const { return fd_; }

 private:
  int fd_;
};

}  // namespace puck
