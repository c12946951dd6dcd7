#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "common/posix/file_descriptor.h"

namespace puck {

/// A TCP connection to 127.0.0.1 that sends any bytes.
class RawClient {
 public:
  explicit RawClient(std::uint16_t port)
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const timeval longest_wait{.tv_sec = 20, .tv_usec = 0};
    setsockopt(socket_.number(), SOL_SOCKET, SO_RCVTIMEO, &longest_wait, sizeof longest_wait);
    is_connected_ =
        connect(socket_.number(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }

  bool is_connected() const { return is_connected_; }

  /// Whether all bytes were taken.
  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(socket_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }

  /// What comes until the server closes, or until `text` holds `end`.
  std::string receive(std::string_view end = {}) {
    std::string text;
    char part[4096];
    while (end.empty() || text.find(end) == std::string::npos) {
      const ssize_t size = recv(socket_.number(), part, sizeof part, 0);
      if (size <= 0) break;
      text.append(part, static_cast<std::size_t>(size));
    }
    return text;
  }

  /// Whether the server has closed, by the end of the wait.
  bool is_closed_within(std::chrono::milliseconds wait) {
    const timeval time{.tv_sec = wait.count() / 1000, .tv_usec = wait.count() % 1000 * 1000};
    setsockopt(socket_.number(), SOL_SOCKET, SO_RCVTIMEO, &time, sizeof time);
    char byte = 0;
    ssize_t size = 0;
    while ((size = recv(socket_.number(), &byte, 1, 0)) > 0) {
    }
    return size == 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
  }

 private:
  FileDescriptor socket_;
  bool is_connected_ = false;
};

}  // namespace puck
