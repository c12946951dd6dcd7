#pragma once

#include <filesystem>
#include <memory>
#include <string_view>

#include "common/events/event_packet.h"
#include "common/events/sensor_size.h"

namespace puck {

/// Writes events to a file. One thread at a time.
class EventWriter {
 public:
  virtual ~EventWriter() = default;

  /// Throws std::invalid_argument for an event outside the sensor or older than the previous one,
  /// EventFileError when the file cannot be written.
  virtual void write(const EventPacket& packet) = 0;

  /// Writes the rest. Throws EventFileError when that fails; the destructor also closes, but
  /// ignores errors.
  virtual void close() = 0;
};

/// `format`: "evt3", "text" (`t x y p`, t in µs), or empty: from the path's ending, .raw or
/// .txt/.csv. Throws EventFileError for another format, an invalid sensor, or a file that cannot be
/// written.
std::unique_ptr<EventWriter> make_event_writer(const std::filesystem::path& path,
                                               std::string_view format, SensorSize sensor);

}  // namespace puck
