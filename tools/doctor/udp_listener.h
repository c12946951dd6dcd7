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

/// The bus cannot be listened to or spoken on; says why.
class ListenError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Hears what is sent to a group and port, with what the kernel knows of each datagram. Bound to
/// the group's address, it takes nothing from those who listen beside it. One thread.
class UdpListener {
 public:
  /// Throws ListenError.
  explicit UdpListener(const LcmUrl& url);
  UdpListener(const UdpListener&) = delete;
  UdpListener& operator=(const UdpListener&) = delete;

  /// The next datagram, if one comes in time. Its bytes last until the next call.
  std::optional<ReceivedDatagram> receive(std::chrono::milliseconds timeout);

 private:
  FileDescriptor socket_;
  std::array<std::uint8_t, 65536> buffer_{};
};

/// The receive buffer, bytes, that the kernel gives to a socket that asks for what `url` says;
/// nothing when it gives no socket.
std::optional<std::int64_t> granted_buffer_bytes(const LcmUrl& url);

}  // namespace puck
