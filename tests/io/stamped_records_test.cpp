// DAT and AEDAT 2.0. No recording in DAT 1 or of a DAVIS in AEDAT 2.0 was to be had: their bytes
// are written from the specifications.
#include <bit>
#include <random>
#include <sstream>

#include <doctest/doctest.h>

#include "common/io/event_stream.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

const std::string kDat2Header =
    "% Data file containing CD events\n% Version 2\n% Width 640\n% Height 480\n\x0c\x08";

std::string text_of_numbers(const std::vector<std::uint32_t>& numbers, bool big_endian = false) {
  std::string text;
  for (const std::uint32_t number : numbers) {
    for (int i = 0; i < 4; ++i) {
      text += static_cast<char>(number >> 8 * (big_endian ? 3 - i : i) & 0xff);
    }
  }
  return text;
}

std::uint32_t dat2(std::uint32_t x, std::uint32_t y, std::uint32_t p) {
  return x | y << 14 | p << 28;
}

struct ReadFile {
  std::vector<PlainEvent> events;
  SensorSize sensor;
  EventCounters counters;
  std::vector<std::string> warnings;
};

ReadFile read_content(const std::string& content, const EventFileOptions& options = {}) {
  const TemporaryFolder folder;
  const auto reader = open_event_file(folder.write("a", content), options);
  ReadFile file;
  file.events = read_all(*reader);
  file.sensor = reader->sensor_size();
  file.counters = reader->counters();
  file.warnings = reader->warnings();
  return file;
}

std::string refusal_of_content(const std::string& content) {
  return message_of<EventFileError>([&] { read_content(content); });
}

TEST_CASE("DAT 2 records become events") {
  const auto file =
      read_content(kDat2Header + text_of_numbers({5, dat2(639, 479, 1), 7, dat2(0, 3, 0)}));
  CHECK(file.sensor == SensorSize{640, 480});
  CHECK(file.events == std::vector<PlainEvent>{{5, 639, 479, 1}, {7, 0, 3, 0}});
  CHECK(file.warnings.empty());
}

TEST_CASE("DAT 1 records become events, also without a version in the header") {
  const std::string records = text_of_numbers({5, 303U | 239U << 9 | 1U << 17, 7, 8U | 3U << 9});
  const std::vector<PlainEvent> expected{{5, 303, 239, 1}, {7, 8, 3, 0}};
  const std::string_view kind("\0\x08", 2);
  CHECK(read_content("% Data file containing events\n% Version 1\n" + std::string(kind) + records)
            .events == expected);
  const auto file = read_content("% Data file containing events\n" + std::string(kind) + records);
  CHECK(file.events == expected);
  CHECK(file.sensor == SensorSize{304, 240});
  REQUIRE(file.warnings.size() == 2);
  CHECK(contains(file.warnings[1], "lacks its line \"% Version\""));
}

TEST_CASE("DAT times wrap after 71.6 minutes, and one glitch is no wrap") {
  const auto times = [](const std::vector<std::uint32_t>& stamps) {
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t stamp : stamps) {
      numbers.push_back(stamp);
      numbers.push_back(dat2(1, 1, 1));
    }
    std::vector<std::int64_t> all;
    for (const auto& event : read_content(kDat2Header + text_of_numbers(numbers)).events) {
      all.push_back(event.t_us);
    }
    return all;
  };
  constexpr std::int64_t kWrap = std::int64_t{1} << 32;
  CHECK(times({0xfffffff0, 0xfffffffe, 3, 5, 100}) ==
        std::vector<std::int64_t>{0xfffffff0, 0xfffffffe, kWrap + 3, kWrap + 5, kWrap + 100});
  // A wrap in a pause of minutes.
  CHECK(times({0xf0000000, 0x10000000, 0x10000001}) ==
        std::vector<std::int64_t>{0xf0000000, kWrap + 0x10000000, kWrap + 0x10000001});
  CHECK(times({1000, 1010, 0x80000000, 1020, 1030}) ==
        std::vector<std::int64_t>{1000, 1010, 1010, 1020, 1030});
  CHECK(times({4'000'000'000, 4'000'000'010, 7, 4'000'000'020}) ==
        std::vector<std::int64_t>{4'000'000'000, 4'000'000'010, 4'000'000'010, 4'000'000'020});
}

TEST_CASE("late DAT events are put in order, and those that are too late are counted") {
  const std::string records =
      text_of_numbers({5000, dat2(1, 0, 1), 6000, dat2(2, 0, 1), 5500, dat2(3, 0, 1), 4999,
                       dat2(4, 0, 1), 6001, dat2(5, 0, 1)});
  const auto file = read_content(kDat2Header + records);
  CHECK(file.events == std::vector<PlainEvent>{
                           {5000, 1, 0, 1}, {5500, 3, 0, 1}, {6000, 2, 0, 1}, {6001, 5, 0, 1}});
  CHECK(file.counters.reordered == 1);
  CHECK(file.counters.backwards == 1);
  CHECK(file.counters.events == 4);
  const auto strict = read_content(kDat2Header + records, {.reorder_us = 0});
  CHECK(strict.events.size() == 3);
  CHECK(strict.counters.backwards == 2);
}

TEST_CASE("DAT files of other records, versions or sizes are refused") {
  CHECK(contains(refusal_of_content("% Data file containing\n% Version 2\n\x0e\x08"),
                 "kind 14 (triggers) and 8 bytes, at byte 35; expected events"));
  CHECK(contains(refusal_of_content("% Data file containing\n% Version 3\n\x0c\x08"),
                 "version 3; expected 1 or 2"));
  CHECK(contains(refusal_of_content("% Version 2\n% Width 640\n\x0c\x08"), "must both be there"));
  CHECK(contains(refusal_of_content("% Version 2\n"), "ends within its DAT header, at byte 12"));
  CHECK(contains(refusal_of_content("% Version two\n\x0c\x08"), "must give a number"));
}

TEST_CASE("AEDAT 2.0 records of a DVS128 and a DAVIS become events") {
  const std::string header = "#!AER-DAT2.0\r\n# AEChip: ch.unizh.ini.jaer.chip.retina.";
  // x = 127 − 2, y = 127 − 3, OFF; and a synchronising pulse.
  const std::string dvs = text_of_numbers({2U << 1 | 3U << 8 | 1U, 100, 0x8000, 101, 0, 110}, true);
  const auto file = read_content(header + "DVS128\r\n" + dvs);
  CHECK(file.sensor == SensorSize{128, 128});
  CHECK(file.events == std::vector<PlainEvent>{{100, 125, 124, 0}, {110, 127, 127, 1}});
  CHECK(file.counters.other_data == 1);

  const std::string davis = text_of_numbers({5U << 12 | 7U << 22 | 1U << 11, 100, 0x80000000, 101,
                                             1U << 10, 102, 239U << 12 | 179U << 22, 110},
                                            true);
  const auto file240 = read_content(header + "DAVIS240C\r\n" + davis);
  CHECK(file240.sensor == SensorSize{240, 180});
  CHECK(file240.events == std::vector<PlainEvent>{{100, 234, 172, 1}, {110, 0, 0, 0}});
  CHECK(file240.counters.other_data == 2);
  CHECK(read_content("#!AER-DAT2.0\r\n" + davis, {.sensor = {346, 260}}).events ==
        std::vector<PlainEvent>{{100, 340, 252, 1}, {110, 106, 80, 0}});
  CHECK(contains(refusal_of_content("#!AER-DAT2.0\r\n" + davis), "expected a DVS128, DAVIS240"));
  const auto unnamed = read_content("#!AER-DAT2.0\r\n" + dvs.substr(0, 8));
  CHECK(unnamed.sensor == SensorSize{128, 128});
  CHECK(contains(unnamed.warnings.at(0), "look like a DVS128's"));
}

TEST_CASE("AEDAT 2.0 data whose first byte is that of # are no header") {
  const std::string header = "#!AER-DAT2.0\r\n# AEChip: eu.seebetter.ini.chips.davis.DAVIS240C\r\n";
  const auto record = [](std::uint32_t address, std::uint32_t stamp) {
    return text_of_numbers({address, stamp}, true);
  };
  // 0x23 is #; times with and without bytes of 0, and with the byte of a line's end.
  for (const std::uint32_t start : {100U, 0x0a0a0a0aU, 0x21222324U}) {
    CAPTURE(start);
    std::string data;
    for (std::uint32_t i = 0; i < 40; ++i) data += record(0x23000800U | i << 12, start + i);
    for (const char* last : {"", "#End Of ASCII Header\r\n", "# End Of ASCII Header\n"}) {
      const auto file = read_content(header + last + data);
      REQUIRE(file.events.size() == 40);
      CHECK(file.events[0] == PlainEvent{start, 239, 179 - 0x8c, 1});
      CHECK(file.events[39] == PlainEvent{start + 39, 239 - 39, 179 - 0x8c, 1});
      CHECK(file.warnings.empty());
    }
  }
  // All of it is printable, up to the byte of a line's end: only the last line can tell.
  const std::string text = record(0x234e2828, 0x2020200a) + record(0x234e2828, 0x2020200b);
  CHECK(read_content(header + "#End Of ASCII Header\r\n" + text).events.size() == 2);
  // Letters beyond ASCII.
  CHECK(read_content(header + "# by Zo\xc3\xab in C:\\\t\r\n#\r\n" + record(0x23000800, 5))
            .events.size() == 1);
}

TEST_CASE("AEDAT 2.0 times wrap after 31 bits or 32") {
  const auto last_us = [](std::uint32_t before, std::uint32_t behind) {
    return read_content("#!AER-DAT2.0\r\n# AEChip: DVS128\r\n" +
                        text_of_numbers({0, before, 0, behind, 0, behind + 1}, true))
        .events.back()
        .t_us;
  };
  CHECK(last_us(0x7fffffff, 0) == (std::int64_t{1} << 31) + 1);
  CHECK(last_us(0x7fffffff, 0x80000000) == (std::int64_t{1} << 31) + 1);
}

TEST_CASE("record events do not depend on the division of the stream") {
  std::mt19937 random(7);
  std::vector<std::uint32_t> numbers;
  std::uint32_t stamp = 0xfffff000;
  for (int i = 0; i < 2000; ++i) {
    stamp += random() % 100;
    if (random() % 300 == 0) stamp += 3'000'000;
    numbers.push_back(random() % 50 == 0 ? stamp - random() % 500 : stamp);
    numbers.push_back(dat2(random() % 650, random() % 490, random() % 2));
  }
  const std::string text = kDat2Header + text_of_numbers(numbers);
  const auto bytes = std::as_bytes(std::span(text));
  const auto decode_in = [&](std::size_t piece, std::size_t max_events, EventCounters& counters) {
    EventStream stream("test", {.reorder_us = 100});
    std::vector<PlainEvent> events;
    EventPacket packet;
    const auto feed = [&](std::span<const std::byte> part) {
      do {
        packet.events.clear();
        part = part.subspan(stream.decode(part, packet, max_events));
        append_plain(packet, events);
      } while (!part.empty() || stream.has_backlog());
    };
    for (std::size_t i = 0; i < bytes.size(); i += piece) {
      feed(bytes.subspan(i, std::min(piece, bytes.size() - i)));
    }
    stream.finish();
    feed({});
    counters = stream.counters();
    return events;
  };
  EventCounters whole;
  const auto expected = decode_in(1 << 20, 1 << 20, whole);
  REQUIRE(expected.size() > 1800);
  CHECK(whole.backwards > 0);
  for (const std::size_t piece : {1, 7, 8, 64}) {
    for (const std::size_t max_events : {1, 33, 1000}) {
      EventCounters counters;
      CHECK(decode_in(piece, max_events, counters) == expected);
      CHECK(counters == whole);
    }
  }
}

}  // namespace
}  // namespace puck
