#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/yarp/tcp_socket.h"
#include "common/yarp/text_lines.h"

namespace puck {

/// A connection in YARP's text carrier, to the name server or a board's port rpc:i. Errors throw
/// YarpError.
class TextConnection {
 public:
  /// Connects as `local_name` and waits for the welcome.
  TextConnection(const PortAddress& address, std::string_view local_name, const Waiter& waiter,
                 Deadline deadline);

  int descriptor() const { return socket_.descriptor(); }

  void send(std::string_view request, const Waiter& waiter, Deadline deadline);
  /// The next line of an answer.
  std::string receive(const Waiter& waiter, Deadline deadline);
  /// The next line, if complete.
  std::optional<std::string> receive_now();

 private:
  TcpSocket socket_;
  TextLines lines_;
};

}  // namespace puck
