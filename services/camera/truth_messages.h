#pragma once

#include "common/events/sensor_size.h"
#include "common/messaging/channels.h"
#include "common/simulation/simulated_truth.h"

namespace puck {

/// The simulated world as messages without headers. `rotated_180`: the camera is mounted upside
/// down, and its events are rotated before publication.
ground_truth_t to_truth_message(const SimulatedTruth& truth, SensorSize sensor, bool rotated_180);
head_state_t to_head_message(const SimulatedTruth& truth, bool rotated_180);

}  // namespace puck
