#include "common/io/event_reader.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "common/io/aedat4_reader.h"
#include "common/io/byte_source.h"
#include "common/io/event_file_kind.h"
#include "common/io/hdf5_reader.h"
#include "common/io/known_sensors.h"
#include "common/io/ordered_reader.h"
#include "common/io/peeked_bytes.h"
#include "common/io/stream_file_reader.h"
#include "common/io/yarp_log_reader.h"

namespace puck {
namespace {

constexpr std::size_t kFileKindBytes = 4096;

std::unique_ptr<EventReader> open_reader(std::unique_ptr<ByteSource> source,
                                         const std::filesystem::path& path,
                                         const EventFileOptions& options) {
  auto bytes = std::make_unique<PeekedBytes>(std::move(source), kFileKindBytes);
  const auto kind = event_file_kind(bytes->name(), bytes->head(), true, options.from);
  switch (*kind) {
    case EventFileKind::kYarpLog:
      return std::make_unique<YarpLogReader>(std::move(bytes), options);
    case EventFileKind::kAedat4:
      return std::make_unique<Aedat4Reader>(std::move(bytes), options);
    case EventFileKind::kHdf5:
      return open_hdf5_reader(std::move(bytes), path, options);
    default:
      return std::make_unique<StreamFileReader>(std::move(bytes), options);
  }
}

/// The next known sensor that holds all events; nothing without an event.
std::optional<SensorSize> measured_sensor(const std::filesystem::path& path,
                                          EventFileOptions options) {
  options.fallback_sensor = {SensorSize::kMax, SensorSize::kMax};
  SensorSize least;
  try {
    const auto events = open_reader(open_bytes(path.string()), path, options);
    EventPacket packet;
    while (events->read(packet, EventReader::kUsualEvents)) {
      for (const Event& event : packet.events) {
        least.width = std::max(least.width, event.x + 1);
        least.height = std::max(least.height, event.y + 1);
      }
    }
  } catch (const EventFileError&) {
    // After events, the caller meets the same fault.
    if (least == SensorSize{}) throw;
  }
  if (least == SensorSize{}) return std::nullopt;
  return next_known_sensor(least);
}

bool can_be_read_twice(const std::filesystem::path& path) {
  std::error_code error;
  return path != "-" && std::filesystem::is_regular_file(path, error);
}

}  // namespace

std::unique_ptr<EventReader> open_event_file(const std::filesystem::path& path,
                                             const EventFileOptions& options) {
  return open_event_bytes(open_bytes(path.string(), options.interruption), path, options);
}

void check_recording_exists(const std::filesystem::path& path) {
  std::error_code error;
  if (path == "-" || std::filesystem::exists(path, error)) return;
  throw EventFileError(path.string() + ": cannot be opened: " +
                       (error ? error.message() : "No such file or directory"));
}

std::unique_ptr<EventReader> open_event_bytes(std::unique_ptr<ByteSource> bytes,
                                              const std::filesystem::path& path,
                                              const EventFileOptions& options) {
  const std::string name = bytes->name();
  std::vector<std::string> notes;
  std::unique_ptr<EventReader> events;
  try {
    events = open_reader(std::move(bytes), path, options);
  } catch (const SensorUnknownError&) {
    const auto sensor = can_be_read_twice(path) ? measured_sensor(path, options) : std::nullopt;
    if (!sensor) throw;
    EventFileOptions complete = options;
    complete.fallback_sensor = *sensor;
    events = open_reader(open_bytes(path.string()), path, complete);
    notes.push_back(path.string() + ": does not say how large the sensor is; took " +
                    std::to_string(sensor->width) + " x " + std::to_string(sensor->height) +
                    ", the next known one that holds all events (--width and --height, or "
                    "camera.width and camera.height, state another)");
  }
  return std::make_unique<OrderedReader>(std::move(events), options.reorder_us, name,
                                         std::move(notes));
}

}  // namespace puck
