#pragma once

#include "common/events/sensor_size.h"
#include "common/messaging/channels.h"
#include "common/simulation/simulated_truth.h"

namespace puck {

/// The simulated world on the wire, but for the header. `rotated_180`: of a camera that hangs
/// upside down, whose events are turned before they are published.
ground_truth_t to_truth_message(const SimulatedTruth& truth, SensorSize sensor, bool rotated_180);
head_state_t to_head_message(const SimulatedTruth& truth, bool rotated_180);

}  // namespace puck
