#include "common/yarp/board_ports.h"

#include "common/yarp/port_query.h"
#include "common/yarp/yarp_error.h"

namespace puck {

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
