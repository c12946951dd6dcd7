#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "common/yarp/binary_carrier.h"
#include "common/yarp/tcp_socket.h"

namespace puck {

/// A connection in YARP's binary carrier: to one of a board's streaming ports. What goes wrong
/// throws BoardError.
class StreamConnection {
 public:
  /// Connects as `local_name` and waits for the answer.
  StreamConnection(const PortAddress& address, std::string_view local_name, const Waiter& waiter,
                   Deadline deadline);

  int descriptor() const { return socket_.descriptor(); }

  // Of a port that sends.

  /// Makes the port send, before the first of these.
  void turn_round(const Waiter& waiter, Deadline deadline);
  std::span<const std::uint8_t> receive(const Waiter& waiter, Deadline deadline);
  /// The next message of those that have come.
  std::optional<std::span<const std::uint8_t>> receive_now();

  // Of a port that takes.

  /// Whether what was given before has left this machine's hands.
  bool is_free() const { return unsent_.empty(); }
  /// When it is free.
  void send(std::span<const std::uint8_t> payload);
  /// Goes on with what is not sent yet, and notices a closed connection.
  void attend();

 private:
  TcpSocket socket_;
  MessageReader messages_;
  Bytes unsent_;
};

}  // namespace puck
