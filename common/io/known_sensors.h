#pragma once

#include <optional>
#include <string_view>

#include "common/events/sensor_size.h"

namespace puck {

/// The sensor of a camera whose name, or its driver's name, occurs in `text` in any case.
std::optional<SensorSize> sensor_of_camera(std::string_view text);

/// The smallest sensor on the market that is at least so wide and high; without one, exactly so.
SensorSize next_known_sensor(SensorSize least);

}  // namespace puck
