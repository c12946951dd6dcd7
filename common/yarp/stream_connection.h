#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "common/yarp/binary_carrier.h"
#include "common/yarp/tcp_socket.h"

namespace puck {

/// A connection to a streaming port in YARP's binary carrier. Errors throw YarpError.
class StreamConnection {
 public:
  /// Connects as `local_name` and waits for the answer. Received messages have up to `most_bytes`.
  StreamConnection(const PortAddress& address, std::string_view local_name, const Waiter& waiter,
                   Deadline deadline, std::size_t most_bytes = MessageReader::kBoardBytes);

  int descriptor() const { return socket_.descriptor(); }

  // For a port that sends.

  /// Makes the port send. Call it before receive_now().
  void turn_round(const Waiter& waiter, Deadline deadline);
  std::span<const std::uint8_t> receive(const Waiter& waiter, Deadline deadline);
  /// The next message received so far.
  std::optional<std::span<const std::uint8_t>> receive_now();

  // For a port that receives.

  /// Whether all bytes of earlier messages have been passed to the kernel.
  bool is_free() const { return unsent_.empty(); }
  /// Call it only when is_free().
  void send(std::span<const std::uint8_t> payload);
  /// Continues an unfinished send, and detects a closed connection.
  void attend();

 private:
  TcpSocket socket_;
  MessageReader messages_;
  Bytes unsent_;
};

}  // namespace puck
