#pragma once

#include <string>

#include "common/messaging/bus.h"
#include "tools/spy/snapshot.h"
#include "tools/spy/stop_signal.h"

namespace puck {

/// What was heard in one go, and why nothing could be, if so.
struct Heard {
  Snapshot snapshot;
  std::string problem;  ///< Empty: the bus was listened to.
};

/// Listens for so long, or until a stop is asked for; counts the wait for a network as listening.
Heard listen(const BusParams& params, double seconds, StopSignal& stop);

/// The live view, until `q` or a stop. Throws std::runtime_error when there is no terminal.
void watch(const BusParams& params, StopSignal& stop);

}  // namespace puck
