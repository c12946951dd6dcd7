#pragma once

#include <string>

#include "common/yarp/board_error.h"
#include "common/yarp/name_server.h"
#include "common/yarp/waiter.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// Where the ports of a control board are.
struct BoardPorts {
  PortAddress requests;
  PortAddress command;
  PortAddress state;
};

/// Asks the name server. Throws BoardError.
BoardPorts find_board_ports(const YarpParams& params, const PortAddress& name_server,
                            const Waiter& waiter);

/// What goes wrong with a port is told with its name.
template <typename Work>
auto at_port(const std::string& name, Work work) {
  try {
    return work();
  } catch (const BoardError& error) {
    throw BoardError(name + ": " + error.what(), error.kind());
  }
}

}  // namespace puck
