#pragma once

#include "common/runtime/latency_histogram.h"

namespace puck {

/// How long this machine takes to wake a sleeping thread from another one, with nothing else to do:
/// what no service can be quicker than. Takes half a second.
LatencySummary measure_machine_wake();

}  // namespace puck
