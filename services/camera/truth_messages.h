#pragma once

#include "common/events/sensor_size.h"
#include "common/io/picture_turn.h"
#include "common/messages/ground_truth.h"
#include "common/messages/head_state.h"
#include "common/simulation/simulated_truth.h"

namespace puck {

/// The simulated world as messages without headers. `turn`: of the camera's events before
/// publication, without swapped axes.
GroundTruth to_truth_message(const SimulatedTruth& truth, SensorSize sensor,
                             const PictureTurn& turn);
HeadState to_head_message(const SimulatedTruth& truth, const PictureTurn& turn);

}  // namespace puck
