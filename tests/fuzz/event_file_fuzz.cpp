// Any file as a recording: the first byte chooses the options, the rest is the file.
#include <array>
#include <limits>
#include <stdexcept>
#include <string_view>

#include "common/io/event_file_kind.h"
#include "common/io/event_reader.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"

namespace puck {
namespace {

EventFileOptions options_of(std::uint8_t choice) {
    constexpr std::array<const char*, 4> kColumns{"t x y p", "x y p t", "t,x,y,p", "p y x t"};
  constexpr std::array<const char*, 4> kUnits{"auto", "s", "us", "ns"};
  EventFileOptions options;
  options.from = kEventFormats[choice % kEventFormats.size()];
  options.text_columns = kColumns[choice >> 2 & 3];
  options.text_unit = kUnits[choice >> 4 & 3];
  if ((choice & 0x40) != 0) options.sensor = {640, 480};
  if ((choice & 0x80) != 0) options.text_separator = ",";
  return options;
}

void check(const EventPacket& packet, SensorSize sensor, Timestamp& newest) {
  for (const Event& event : packet.events) {
    require(sensor.contains(event.x, event.y), "events lie inside the sensor");
    require(packet.time_of(event) >= newest, "events are in the order of their times");
    newest = packet.time_of(event);
  }
}

std::int64_t read_all(EventReader& reader, std::size_t max_events) {
  Timestamp newest{std::numeric_limits<std::int64_t>::min()};
  EventPacket packet;
  std::int64_t events = 0;
  while (reader.read(packet, max_events)) {
    require(packet.events.size() <= max_events, "a packet holds no more than was asked for");
    check(packet, reader.sensor_size(), newest);
    events += static_cast<std::int64_t>(packet.events.size());
  }
  require(packet.empty(), "the last packet is empty");
  require(reader.counters().events == events, "events are counted");
  for (const std::string& warning : reader.warnings()) require_one_line(warning);
  return events;
}

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  // Of any other bytes HDF5's library makes its own errors, which are not looked for here.
  constexpr std::string_view kHdf5("\x89HDF", 4);
  if (std::string_view(reinterpret_cast<const char*>(data) + 1, size - 1).starts_with(kHdf5)) {
    return 0;
  }
  puck::MemoryFile file;
  const auto& path = file.write(data + 1, size - 1);
  try {
    const auto reader = puck::open_event_file(path, puck::options_of(data[0]));
    const std::int64_t events = puck::read_all(*reader, 7);
    const puck::EventCounters counters = reader->counters();
    reader->rewind();
    puck::require(puck::read_all(*reader, 5000) == events && reader->counters() == counters,
                  "a second reading gives the same");
  } catch (const puck::EventFileError& error) {
    puck::require_one_line(error.what());
  }
  return 0;
}
