#pragma once

#include "common/events/event.h"
#include "common/events/sensor_size.h"
#include "common/events/timestamp.h"

namespace puck {

/// Checks of the events of every writer.

/// Returns `sensor` if it is valid; else throws std::invalid_argument.
SensorSize checked_sensor(SensorSize sensor);

/// Throws std::invalid_argument for an event outside the sensor, or older than `newest`.
void check_event(const Event& event, Timestamp time, SensorSize sensor, Timestamp newest);

}  // namespace puck
