#include "common/messaging/event_log.h"

#include <fstream>
#include <limits>

#include <doctest/doctest.h>

#include "tests/support/event_log_writer.h"
#include "tests/support/temporary_folder.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{64, 48};

std::vector<std::int64_t> starts_of(EventLog& log) {
  std::vector<std::int64_t> starts;
  EventPacket packet;
  while (log.read(packet, 100'000)) starts.push_back(packet.start.us);
  CHECK(packet.empty());
  return starts;
}

bool tells(const EventLog& log, const std::string& part) {
  for (const std::string& problem : log.problems()) {
    if (problem.find(part) != std::string::npos) return true;
  }
  return false;
}

std::string refusal_of(const std::filesystem::path& path, const std::string& prefix) {
  try {
    const EventLog log(path, prefix, EventLog::Sessions::kFirst);
    return {};
  } catch (const LogFileError& error) {
    return error.what();
  }
}

TEST_CASE("a log without events names the prefixes that have events, and repeats no other name") {
  const TemporaryFolder folder;
  for (const char* name : {"LEFT_PUCK_EVENTS", "left_PUCK_EVENTS", "A\x1b[2J_PUCK_EVENTS"}) {
    LogWriter(folder / "a.lcm", true).write(name, 1, {});
    const std::string refusal = refusal_of(folder / "a.lcm", "");
    CAPTURE(refusal);
    const bool names_it = refusal.find(std::string("it has ") + name) != std::string::npos;
    CHECK(names_it == (name == std::string("LEFT_PUCK_EVENTS")));
    CHECK(refusal.find('\x1b') == std::string::npos);
  }
}

TEST_CASE("a log's packets are read in the order of receipt, a large one in pieces, reproducibly") {
  const TemporaryFolder folder;
  {
    EventLogWriter writer(folder / "a.lcm", kSensor);
    writer.write(numbered_events(5000, 100));
    writer.write(numbered_events(7000, 40));
  }
  EventLog log(folder / "a.lcm", "", EventLog::Sessions::kFirst);
  CHECK(log.sensor_size() == kSensor);
  CHECK(log.session() == 1);
  EventPacket packet;
  for (int round = 0; round < 2; ++round) {
    for (const std::size_t expected : {70, 30, 40}) {
      REQUIRE(log.read(packet, 70));
      CHECK(packet.events.size() == expected);
    }
    CHECK(packet.newest().us == 7000 + 39 * 10);
    CHECK_FALSE(log.read(packet, 70));
    CHECK(log.counters().packets == 2);
    CHECK(log.counters().events == 140);
    CHECK(log.problems().empty());
    log.rewind();
  }
}

TEST_CASE("missing, late, duplicate and malformed packets of a log are counted, others are read") {
  const TemporaryFolder folder;
  {
    EventLogWriter writer(folder / "a.lcm", kSensor);
    writer.write(numbered_events(1000, 10));
    writer.lose(numbered_events(2000, 20));
    writer.write(numbered_events(3000, 10));
    const event_packet_t early = writer.last();
    writer.write(numbered_events(4000, 10));
    writer.write_raw(early, 4001);          // Late.
    writer.write_raw(writer.last(), 4002);  // Twice.
    writer.write_bytes("PUCK_EVENTS", 4003, {1, 2, 3});
    event_packet_t backwards = writer.last();
    backwards.seq += 1;
    backwards.first_event_us = 500;
    writer.write_raw(backwards, 4004);
    writer.write(numbered_events(5000, 10));
  }
  EventLog log(folder / "a.lcm", "", EventLog::Sessions::kFirst);
  CHECK(starts_of(log) == std::vector<std::int64_t>{1000, 3000, 4000});
  CHECK(log.counters().packets_missing == 1);
  CHECK(log.counters().events_missing == 20);
  // The last packet has a number that the one before has used.
  CHECK(log.counters().packets_late == 4);
  CHECK(log.counters().packets_malformed == 1);
  CHECK(tells(log, "1 packets of events missing; together with late packets, 20 events"));
  CHECK(tells(log, "1 packets of events left out: malformed"));
}

TEST_CASE("a restarted camera continues its sensor time, with the pause between the sessions") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  {
    EventLogWriter writer(path, kSensor);
    writer.begin_session(7, 10'000'000);
    writer.write(numbered_events(1000, 10));
    writer.write(numbered_events(2000, 1));  // Heard at 10.002 s.
    writer.begin_session(8, 10'003'000);     // Heard at 10.003 s: another camera beside it.
    writer.write(numbered_events(0, 10));
    writer.begin_session(9, 12'000'000);
    writer.write(numbered_events(500, 10));  // Heard at 12.0005 s.
    writer.write(numbered_events(900, 10));
  }
  EventLog joined(path, "", EventLog::Sessions::kJoined);
  CHECK(starts_of(joined) == std::vector<std::int64_t>{1000, 2000, 2'000'500, 2'000'900});
  CHECK(joined.session() == 9);
  CHECK(joined.counters().packets_of_others == 1);
  CHECK(joined.counters().packets_missing == 0);
  EventLog first(path, "", EventLog::Sessions::kFirst);
  CHECK(starts_of(first) == std::vector<std::int64_t>{1000, 2000});
  CHECK(first.session() == 7);
  CHECK(tells(first, "3 packets of events left out"));
}

TEST_CASE("a log without events under the prefix is refused, and its own prefix is named") {
  const TemporaryFolder folder;
  { EventLogWriter(folder / "a.lcm", kSensor, "LEFT_PUCK_EVENTS").write(numbered_events(0, 1)); }
  CHECK_NOTHROW(EventLog(folder / "a.lcm", "LEFT", EventLog::Sessions::kFirst));
  const std::string text = refusal_of(folder / "a.lcm", "");
  CHECK(text.find("a log without events on PUCK_EVENTS; it has LEFT_PUCK_EVENTS") !=
        std::string::npos);
  CHECK(refusal_of(folder / "none.lcm", "").find("cannot be read") != std::string::npos);
}

TEST_CASE("the intact part of a damaged log is read, and the damage is reported") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  {
    EventLogWriter writer(path, kSensor);
    for (int i = 0; i < 100; ++i) writer.write(numbered_events(1000 * i, 50));
  }
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(path));
  {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(size / 2);
    file << std::string(600, '\xff');
  }
  std::filesystem::resize_file(path, static_cast<std::uintmax_t>(size - 5));
  EventLog log(path, "", EventLog::Sessions::kJoined);
  const auto starts = starts_of(log);
  CHECK(starts.size() >= 95);
  CHECK(starts.size() < 99);
  CHECK(starts.back() == 98'000);
  CHECK(log.counters().packets_missing == 99 - static_cast<std::int64_t>(starts.size()));
  CHECK(tells(log, "bytes skipped"));
}

TEST_CASE("stamps and times at the end of their range are unchanged") {
  const TemporaryFolder folder;
  const auto path = folder / "a.lcm";
  constexpr std::int64_t kFar = std::int64_t{1} << 53;
  {
    EventLogWriter writer(path, kSensor);
    writer.write(numbered_events(1000, 1));
    event_packet_t packet = writer.last();
    packet.events_dropped = kFar;
    for (int i = 0; i < 3000; ++i) {
      packet.session = 100 + i;
      packet.first_event_us = kFar - 4095;
      // Silence after each one, so that the next publisher is followed.
      writer.write_raw(packet, i % 2 == 0 ? std::numeric_limits<std::int64_t>::max()
                                          : std::numeric_limits<std::int64_t>::min());
    }
  }
  EventLog log(path, "", EventLog::Sessions::kJoined);
  std::int64_t newest_us = 0;
  for (const std::int64_t start_us : starts_of(log)) {
    REQUIRE(start_us >= newest_us);
    newest_us = start_us;
  }
  CHECK(newest_us <= kFar);
  CHECK(log.counters().events_dropped <= kFar);
}

}  // namespace
}  // namespace puck
