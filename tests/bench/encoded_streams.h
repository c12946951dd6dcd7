#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"

namespace puck {

/// The events as a file of this format: "evt2", "evt21", "evt4", "dat", "es", "aedat2" (of a DAVIS)
/// or "text". They must follow one another within a second, and lie in the sensor, which is at most
/// 1024 × 512.
std::vector<std::byte> encoded_stream(std::string_view format, const EventPacket& events,
                                      SensorSize sensor);

}  // namespace puck
