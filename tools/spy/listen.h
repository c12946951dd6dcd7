#pragma once

#include <string>

#include "common/messaging/bus.h"
#include "common/monitor/bus_snapshot.h"
#include "tools/spy/stop_signal.h"

namespace puck {

/// The result of listening.
struct Heard {
  BusSnapshot snapshot;
  std::string problem;  ///< Why it could not listen; empty: it did.
};

/// Listens for `seconds` or until a stop; includes the wait for a network.
Heard listen(const BusParams& params, double seconds, StopSignal& stop);

/// The live view, until `q` or a stop. Throws std::runtime_error without a terminal.
void watch(const BusParams& params, StopSignal& stop);

}  // namespace puck
