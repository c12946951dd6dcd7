#include "common/yarp/board_ports.h"

#include <optional>

#include "common/yarp/text_connection.h"

namespace puck {
namespace {

PortAddress find_port(TextConnection& name_server, const std::string& name, const Waiter& waiter,
                      Deadline deadline) {
  // Other versions may add lines to an answer.
  constexpr int kMostLines = 8;
  name_server.send("query " + name, waiter, deadline);
  std::optional<PortAddress> address;
  for (int i = 0; i < kMostLines; ++i) {
    const std::string line = name_server.receive(waiter, deadline);
    if (line == kEndOfAnswer) {
      if (!address) throw BoardError("there is no port " + name + ": is the robot running?");
      return *address;
    }
    if (!address) address = parse_registration(line, name);
  }
  throw BoardError("its answer to a query for " + name + " has no end");
}

}  // namespace

BoardPorts find_board_ports(const YarpParams& params, const PortAddress& name_server,
                            const Waiter& waiter) {
  return at_port("the name server", [&]() -> BoardPorts {
    TextConnection connection(name_server, params.local_name, waiter,
                              in_ms(params.connect_timeout_ms));
    const auto find = [&](const char* port) {
      return find_port(connection, params.port_name(port), waiter, in_ms(params.answer_timeout_ms));
    };
    return {find("rpc:i"), find("command:i"), find("state:o")};
  });
}

}  // namespace puck
