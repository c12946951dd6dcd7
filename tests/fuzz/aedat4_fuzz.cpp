// Any bytes as an AEDAT4 file; from its second half on behind a sound header.
#include <limits>
#include <string>

#include "common/io/aedat4_writer.h"
#include "common/io/event_reader.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"

namespace puck {
namespace {

std::int64_t read_aedat4(EventReader& reader, std::size_t max_events) {
  Timestamp newest{std::numeric_limits<std::int64_t>::min()};
  EventPacket packet;
  std::int64_t events = 0;
  while (reader.read(packet, max_events)) {
    for (const Event& event : packet.events) {
      require(reader.sensor_size().contains(event.x, event.y), "events lie inside the sensor");
      require(packet.time_of(event) >= newest, "events are in the order of their times");
      newest = packet.time_of(event);
    }
    events += static_cast<std::int64_t>(packet.events.size());
  }
  for (const std::string& warning : reader.warnings()) require_one_line(warning);
  return events;
}

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 2) return 0;
  puck::MemoryFile file;
  std::string bytes;
  if ((data[0] & 1) != 0) {
    const auto& header = file.write(data, 0);
    puck::Aedat4Writer(header, {64, 48}).close();
    bytes.resize(4096);
    std::FILE* const stored = std::fopen(header.c_str(), "rb");
    bytes.resize(std::fread(bytes.data(), 1, bytes.size(), stored));
    std::fclose(stored);
    // The compression of the header.
    bytes[18 + 28] = static_cast<char>(data[1] % 5);
  } else {
    bytes = "#!AER-DAT4.0\r\n";
  }
  bytes.append(reinterpret_cast<const char*>(data) + 2, size - 2);
  const auto& path = file.write(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  try {
    const auto reader = puck::open_event_file(path);
    const std::int64_t events = puck::read_aedat4(*reader, 7);
    reader->rewind();
    puck::require(puck::read_aedat4(*reader, 5000) == events, "a second reading gives the same");
  } catch (const puck::EventFileError& error) {
    puck::require_one_line(error.what());
  }
  return 0;
}
