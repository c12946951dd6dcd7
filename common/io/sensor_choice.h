#pragma once

#include <optional>
#include <string>

#include "common/events/sensor_size.h"
#include "common/io/event_reader.h"

namespace puck {

/// The sensor of a file or stream called `name`: as it states, else `options.sensor`, else that of
/// its camera, else `options.fallback_sensor`. Throws EventFileError when what it states is invalid
/// or the options contradict it, SensorUnknownError when nothing tells the size.
SensorSize choose_sensor(const std::string& name, std::optional<SensorSize> stated,
                         std::optional<SensorSize> of_camera, const EventFileOptions& options);

}  // namespace puck
