#pragma once

#include <string>

#include "common/yarp/board_error.h"
#include "common/yarp/name_server.h"
#include "common/yarp/waiter.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// Addresses of a control board's ports.
struct BoardPorts {
  PortAddress requests;
  PortAddress command;
  PortAddress state;
};

/// Queries the name server. Throws BoardError.
BoardPorts find_board_ports(const YarpParams& params, const PortAddress& name_server,
                            const Waiter& waiter);

/// Adds the port's name to the message of a BoardError from `work`.
template <typename Work>
auto at_port(const std::string& name, Work work) {
  try {
    return work();
  } catch (const BoardError& error) {
    throw BoardError(name + ": " + error.what(), error.kind());
  }
}

}  // namespace puck
