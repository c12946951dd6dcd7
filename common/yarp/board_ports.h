#pragma once

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

/// Queries the name server. Throws YarpError.
BoardPorts find_board_ports(const YarpParams& params, const PortAddress& name_server,
                            const Waiter& waiter);

}  // namespace puck
