#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/posix/file_descriptor.h"
#include "common/yarp/name_server.h"
#include "common/yarp/waiter.h"

namespace puck {

/// A TCP connection that never blocks for longer than it is told. What goes wrong with it throws
/// BoardError.
class TcpSocket {
 public:
  TcpSocket(const PortAddress& address, const Waiter& waiter, Deadline deadline);

  int descriptor() const { return socket_.number(); }

  /// As many bytes as there is room for now.
  std::size_t send_now(std::span<const std::uint8_t> bytes);
  /// As many bytes as have come; none: nothing new.
  std::size_t receive_now(std::span<std::uint8_t> bytes);

  /// All of them.
  void send(std::span<const std::uint8_t> bytes, const Waiter& waiter, Deadline deadline);
  /// At least one.
  std::size_t receive(std::span<std::uint8_t> bytes, const Waiter& waiter, Deadline deadline);

 private:
  FileDescriptor socket_;
};

}  // namespace puck
