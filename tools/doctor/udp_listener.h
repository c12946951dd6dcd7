#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "common/messaging/lcm_url.h"
#include "common/posix/file_descriptor.h"
#include "tools/doctor/traffic.h"

namespace puck {

/// The socket cannot be opened; what() gives the reason.
class ListenError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Receives the datagrams of a group and port, with the kernel's metadata. Bound to the group's
/// address, it takes no datagram from other receivers. One thread.
class UdpListener {
 public:
  /// Throws ListenError.
  explicit UdpListener(const LcmUrl& url);
  UdpListener(const UdpListener&) = delete;
  UdpListener& operator=(const UdpListener&) = delete;

  /// The next datagram, if it arrives in time. Its bytes are valid until the next call.
  std::optional<ReceivedDatagram> receive(std::chrono::milliseconds timeout);

 private:
  FileDescriptor socket_;
  std::array<std::uint8_t, 65536> buffer_{};
};

/// The receive buffer, bytes, that the kernel grants to a socket with this `url`; empty without a
/// socket.
std::optional<std::int64_t> granted_buffer_bytes(const LcmUrl& url);

}  // namespace puck
