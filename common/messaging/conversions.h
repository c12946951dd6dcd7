#pragma once

#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"
#include "common/table/head_pose.h"
#include "common/vision/geometry/truth_row.h"
#include "common/vision/interfaces/puck_estimate.h"
#include "puck/ground_truth_t.hpp"
#include "puck/head_state_t.hpp"
#include "puck/puck_estimate_t.hpp"

namespace puck {

/// The estimate as a message. The tracker service fills in the header, the session of the events,
/// the chain of times, the backlog and the loss counters.
puck_estimate_t to_message(const PuckEstimate& estimate, SensorSize sensor);

/// Head pose at `at`, without the header.
head_state_t to_message(const HeadPose& pose, Timestamp at);

/// For a message from a Bus.
PuckEstimate from_message(const puck_estimate_t& message);
TruthRow from_message(const ground_truth_t& message);
HeadPose from_message(const head_state_t& message);

}  // namespace puck
