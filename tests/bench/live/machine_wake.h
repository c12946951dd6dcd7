#pragma once

#include "common/runtime/latency_histogram.h"

namespace puck {

/// Time that this machine takes to wake a sleeping thread from another one, without other load: a
/// lower bound for every service. Takes half a second.
LatencySummary measure_machine_wake();

}  // namespace puck
