#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "common/events/sensor_size.h"
#include "common/io/event_writer.h"

namespace puck {

/// Writes events as one session of a camera into a new LCM log, on PUCK_EVENTS with `prefix` before
/// it. The log's times are those of the sensor, so that a player keeps the pace. `path` "-": a
/// temporary file, which `close` copies to standard output. Throws EventFileError,
/// std::invalid_argument for an invalid sensor.
std::unique_ptr<EventWriter> make_event_log_writer(const std::filesystem::path& path,
                                                   SensorSize sensor, const std::string& prefix);

}  // namespace puck
