#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "common/messaging/lcm_url.h"
#include "tools/doctor/traffic.h"

namespace puck {

/// Hears what is sent to a group and port, with what the kernel knows of each datagram. Bound to
/// the group's address, it takes nothing from those who listen beside it. One thread.
class UdpListener {
 public:
  /// Throws std::runtime_error, saying why, when it cannot listen.
  explicit UdpListener(const LcmUrl& url);
  ~UdpListener();
  UdpListener(const UdpListener&) = delete;
  UdpListener& operator=(const UdpListener&) = delete;

  /// The next datagram, if one comes in time. Its bytes last until the next call.
  std::optional<ReceivedDatagram> receive(std::chrono::milliseconds timeout);

 private:
  int socket_;
  std::array<std::uint8_t, 65536> buffer_{};
};

/// The receive buffer, bytes, that the kernel gives to a socket that asks for what `url` says;
/// nothing when it gives no socket.
std::optional<std::int64_t> granted_buffer_bytes(const LcmUrl& url);

}  // namespace puck
