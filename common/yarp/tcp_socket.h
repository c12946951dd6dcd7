#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "common/posix/file_descriptor.h"
#include "common/yarp/name_server.h"
#include "common/yarp/waiter.h"

namespace puck {

/// A TCP connection without unbounded blocking. Errors throw YarpError.
class TcpSocket {
 public:
  TcpSocket(const PortAddress& address, const Waiter& waiter, Deadline deadline);

  int descriptor() const { return socket_.number(); }

  /// Sends as many bytes as fit now; returns their number.
  std::size_t send_now(std::span<const std::uint8_t> bytes);
  /// Receives the bytes that have come; returns their number, 0 for none.
  std::size_t receive_now(std::span<std::uint8_t> bytes);

  /// Sends all bytes.
  void send(std::span<const std::uint8_t> bytes, const Waiter& waiter, Deadline deadline);
  /// Receives at least one byte.
  std::size_t receive(std::span<std::uint8_t> bytes, const Waiter& waiter, Deadline deadline);

 private:
  FileDescriptor socket_;
};

}  // namespace puck
