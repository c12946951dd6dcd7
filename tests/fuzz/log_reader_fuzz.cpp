// Any file as a log, and as a recording of its events.
#include <cstdint>
#include <limits>
#include <tuple>
#include <vector>

#include "common/messaging/event_log.h"
#include "common/messaging/log_file.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/require.h"

namespace puck {
namespace {

void read_records(const std::filesystem::path& path, std::size_t size) {
  LogReader reader(path);
  LogRecord record;
  std::int64_t bytes = 0;
  while (reader.next(record)) {
    bytes += LogWriter::record_bytes(record.channel, record.bytes.size());
  }
  // Every left out byte is counted.
  require(bytes + reader.bytes_skipped() == static_cast<std::int64_t>(size),
          "every byte is read or counted as skipped");
  require(reader.damage().has_value() == (reader.bytes_skipped() > 0),
          "what is skipped is told of");
  if (reader.damage()) require_one_line(*reader.damage());
}

using HeardEvent = std::tuple<std::int64_t, int, int, int>;

std::vector<HeardEvent> events_of(EventLog& log, std::size_t max_events) {
  std::vector<HeardEvent> events;
  Timestamp newest{std::numeric_limits<std::int64_t>::min()};
  EventPacket packet;
  while (log.read(packet, max_events)) {
    require(packet.events.size() <= max_events, "a packet holds no more than was asked for");
    for (const Event& event : packet.events) {
      require(log.sensor_size().contains(event.x, event.y), "events lie inside the sensor");
      require(packet.time_of(event) >= newest, "events are in the order of their times");
      newest = packet.time_of(event);
      events.emplace_back(newest.us, event.x, event.y, event.polarity);
    }
  }
  require(packet.events.empty(), "the last packet is empty");
  const EventLogCounters& counters = log.counters();
  require(counters.events == static_cast<std::int64_t>(events.size()), "events are counted");
  for (const std::int64_t count :
       {counters.packets_malformed, counters.packets_late, counters.packets_of_others,
        counters.packets_missing, counters.events_missing, counters.events_dropped}) {
    require(count >= 0, "no count is negative");
  }
  for (const std::string& problem : log.problems()) require_one_line(problem);
  return events;
}

void read_events(const std::filesystem::path& path, EventLog::Sessions sessions) {
  EventLog log(path, "", sessions);
  const std::vector<HeardEvent> events = events_of(log, 7);
  log.rewind();
  require(events_of(log, 5000) == events, "a second reading gives the same");
}

}  // namespace
}  // namespace puck

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  puck::MemoryFile file;
  const auto& path = file.write(data, size);
  const auto read = [](const auto& reader) {
    try {
      reader();
    } catch (const puck::LogFileError& error) {
      puck::require_one_line(error.what());
    }
  };
  read([&] { puck::read_records(path, size); });
  for (const auto sessions :
       {puck::EventLog::Sessions::kFirst, puck::EventLog::Sessions::kJoined}) {
    read([&] { puck::read_events(path, sessions); });
  }
  return 0;
}
