// The text log of an IIT camera in its three encodings, and damaged ones.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "common/io/event_reader.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"
#include "tests/support/recordings.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/yarp_log_encoder.h"

namespace puck {
namespace {

constexpr SensorSize kAtis{304, 240};

// Packets of 1 ms, twenty events in each, anywhere on the sensor.
std::vector<PlainEvent> random_events(int packets) {
  std::mt19937 random(40);
  std::vector<PlainEvent> events;
  for (int i = 0; i < 20 * packets; ++i) {
    events.push_back({i * 50, static_cast<int>(random() % 304), static_cast<int>(random() % 240),
                      static_cast<int>(random() % 2)});
  }
  return events;
}

constexpr std::size_t kEventsInPacket = 20;
constexpr std::int64_t kPacketUs = 1000;

std::vector<std::vector<PlainEvent>> packets_of(const std::vector<PlainEvent>& events) {
  std::vector<std::vector<PlainEvent>> packets;
  for (std::size_t i = 0; i < events.size(); i += kEventsInPacket) {
    packets.emplace_back(events.begin() + static_cast<std::ptrdiff_t>(i),
                         events.begin() + static_cast<std::ptrdiff_t>(i + kEventsInPacket));
  }
  return packets;
}

std::string encoded(const std::vector<PlainEvent>& events, YarpEncoding encoding,
                    std::uint32_t first_stamp = 383'033'170) {
  YarpLogEncoder encoder(encoding, {events.front().t_us}, first_stamp);
  for (const auto& packet : packets_of(events)) encoder.add(packet_of(packet), kPacketUs);
  return encoder.text();
}

struct ReadLog {
  std::vector<PlainEvent> events;
  EventCounters counters;
  std::vector<std::string> warnings;
};

ReadLog read_log(const std::string& text, EventFileOptions options = {.sensor = kAtis}) {
  const TemporaryFolder folder;
  write_text(folder / "data.log", text);
  const auto reader = open_event_file(folder / "data.log", options);
  ReadLog log;
  log.events = read_all(*reader, 7);
  log.counters = reader->counters();
  log.warnings = reader->warnings();
  reader->rewind();
  CHECK(read_all(*reader, 1000) == log.events);
  CHECK(reader->counters() == log.counters);
  return log;
}

}  // namespace

TEST_CASE("lists and stamped records of a YARP log give the written events") {
  const std::vector<PlainEvent> events = random_events(50);
  for (const YarpEncoding encoding : {YarpEncoding::kList, YarpEncoding::kStamped}) {
    CAPTURE(static_cast<int>(encoding));
    const ReadLog log = read_log(encoded(events, encoding));
    CHECK(log.events == events);
    CHECK(log.warnings.empty());
  }
}

TEST_CASE("a stamp counter that wraps after 31 bits, or begins at 0, loses nothing") {
  const std::vector<PlainEvent> events = random_events(50);
  for (const YarpEncoding encoding : {YarpEncoding::kList, YarpEncoding::kStamped}) {
    for (const std::uint32_t first : {0x7fffffffU - 20'000, 0U}) {
      CHECK(read_log(encoded(events, encoding, first)).events == events);
    }
  }
}

TEST_CASE("records without stamps are spread evenly over their packet's duration") {
  const std::vector<PlainEvent> events = random_events(50);
  const ReadLog log = read_log(encoded(events, YarpEncoding::kPlain));
  REQUIRE(log.events.size() == events.size());
  CHECK(log.warnings.empty());
  for (std::size_t i = 0; i < events.size(); ++i) {
    CHECK(log.events[i].x == events[i].x);
    CHECK(log.events[i].y == events[i].y);
    CHECK(log.events[i].polarity == events[i].polarity);
    CHECK(std::abs(log.events[i].t_us - events[i].t_us) <= 50);
  }
}

TEST_CASE("a pause longer than the counter's period is measured by the host's clock") {
  // 80 ns in 31 bits are 171.8 s.
  std::vector<PlainEvent> events = random_events(2);
  for (std::size_t i = kEventsInPacket; i < events.size(); ++i) events[i].t_us += 600'000'000;
  const ReadLog log = read_log(encoded(events, YarpEncoding::kList));
  CHECK(log.events == events);
  CHECK(log.warnings.empty());
}

TEST_CASE("one eye's events are read, the other's and samples of other sensors are counted") {
  const std::vector<PlainEvent> events = random_events(5);
  YarpLogEncoder encoder(YarpEncoding::kList, {0});
  bool right = false;
  for (const auto& packet : packets_of(events)) {
    encoder.add(packet_of(packet), kPacketUs, right);
    encoder.add_other({packet.back().t_us}, "IMUS (1 2 3) SKE (4 (5 6))");
    right = !right;
  }
  const ReadLog most = read_log(encoder.text());
  CHECK(most.events.size() == 60);
  CHECK(most.events.front() == events.front());
  CHECK(most.counters.other_data == 40 + 10);
  REQUIRE(most.warnings.size() == 1);
  CHECK(contains(most.warnings[0], "50 records are of other sensors or of the other eye"));

  const ReadLog rest = read_log(encoder.text(), {.sensor = kAtis, .yarp_eye = "right"});
  REQUIRE(rest.events.size() == 40);
  CHECK(rest.events.front().x == events[20].x);
  CHECK(rest.events.front().t_us == 0);
}

TEST_CASE("a second time in each line is the receipt's and changes nothing") {
  const std::vector<PlainEvent> events = random_events(3);
  std::string text = encoded(events, YarpEncoding::kList);
  for (std::size_t at = 0; (at = text.find(" AE", at)) != std::string::npos; at += 20) {
    text.insert(at, " 1569859399.5");
  }
  CHECK(read_log(text).events == events);
}

TEST_CASE("a log truncated anywhere keeps all whole events before that, with a warning") {
  const std::vector<PlainEvent> events = random_events(3);
  for (const YarpEncoding encoding : {YarpEncoding::kList, YarpEncoding::kStamped}) {
    const std::string text = encoded(events, encoding);
    const std::size_t first_line = text.find('\n') + 1;
    std::size_t before = 0;
    for (std::size_t length = first_line; length < text.size(); ++length) {
      const ReadLog log = read_log(text.substr(0, length));
      REQUIRE(log.events.size() >= kEventsInPacket);
      REQUIRE(log.events.size() >= before);
      REQUIRE(std::equal(log.events.begin(), log.events.end(), events.begin()));
      before = log.events.size();
    }
    CHECK(before == events.size());
    const ReadLog cut = read_log(text.substr(0, text.size() - 10));
    CHECK(cut.events.size() == events.size() - 1);
    REQUIRE(cut.warnings.size() == 1);
    CHECK(contains(cut.warnings[0], "cut off in the middle"));
  }
}

// Of the first event in that packet of a list.
std::string with_stamp(std::string text, int packet, std::int64_t stamp) {
  std::size_t at = 0;
  for (int i = 0; i <= packet; ++i) at = text.find("AE (", at + 1);
  const std::size_t end = text.find(' ', at + 4);
  return text.replace(at + 4, end - at - 4, std::to_string(stamp));
}

TEST_CASE("a damaged stamp at any place costs only its own event") {
  const std::vector<PlainEvent> events = random_events(20);
  const std::string text = encoded(events, YarpEncoding::kList);
  constexpr std::int64_t kFirst = 383'033'170;
  // Far back and far ahead; 0.9 s and 5 ms ahead.
  for (const std::int64_t wrong : {std::int64_t{5}, std::int64_t{0x60000000}, kFirst + 11'250'000,
                                   kFirst + 9 * 12'500 + 62'500}) {
    CAPTURE(wrong);
    std::vector<PlainEvent> rest = events;
    rest.erase(rest.begin() + 9 * static_cast<int>(kEventsInPacket));
    const ReadLog log = read_log(with_stamp(text, 9, wrong));
    CHECK(log.events == rest);
    CHECK(log.counters.time_glitches == 1);
    REQUIRE(log.warnings.size() == 1);
  }
  for (const std::int64_t wrong : {std::int64_t{5}, std::int64_t{0x60000000}}) {
    const ReadLog log = read_log(with_stamp(text, 0, wrong));
    CHECK(log.counters.time_glitches == 1);
    REQUIRE(log.events.size() == events.size() - 1);
    CHECK(log.events.front() == PlainEvent{0, events[1].x, events[1].y, events[1].polarity});
    CHECK(log.events.back().t_us == events.back().t_us - 50);
  }
}

TEST_CASE("a late packet is left out, and counted") {
  const std::vector<PlainEvent> events = random_events(20);
  YarpLogEncoder encoder(YarpEncoding::kList, {0});
  const auto packets = packets_of(events);
  for (const std::size_t i : {0, 1, 3, 2, 4}) encoder.add(packet_of(packets[i]), kPacketUs);
  const ReadLog late = read_log(encoder.text(), {.sensor = kAtis, .reorder_us = 0});
  CHECK(late.events.size() == 80);
  CHECK(late.counters.backwards == 20);
  CHECK(late.events.back() == packets[4].back());
}

TEST_CASE("after a counter's reset time continues, and nothing is lost") {
  const std::vector<PlainEvent> events = random_events(40);
  YarpLogEncoder encoder(YarpEncoding::kList, {0});
  YarpLogEncoder again(YarpEncoding::kList, {0}, 100);
  const auto packets = packets_of(events);
  for (std::size_t i = 0; i < packets.size(); ++i) {
    (i < 20 ? encoder : again).add(packet_of(packets[i]), kPacketUs);
  }
  // The second count begins 20 ms after its own zero; its host times continue the log's.
  const ReadLog log = read_log(encoder.text() + again.text());
  CHECK(log.counters.time_glitches == 0);
  REQUIRE(log.events.size() == events.size());
  CHECK(std::abs(log.events.back().t_us - events.back().t_us) <= 1000);
}

// Moves the time of one line of the log, counted from 0, by so many seconds.
std::string with_host_time_moved(const std::string& text, int line, double by_s) {
  std::istringstream lines(text);
  std::string moved;
  int number = 0;
  for (std::string one; std::getline(lines, one); ++number) {
    if (number == line) {
      const std::size_t at = one.find(' ') + 1;
      const std::size_t end = one.find(' ', at);
      char time[40];
      std::snprintf(time, sizeof time, "%.6f", std::stod(one.substr(at, end - at)) + by_s);
      one.replace(at, end - at, time);
    }
    moved += one + '\n';
  }
  return moved;
}

TEST_CASE("a damaged host time changes no event's time") {
  const std::vector<PlainEvent> events = random_events(20);
  for (const double by_s : {600.0, 90.0, -600.0, 9e10, -5e8}) {
    for (const int line : {0, 9, 19}) {
      CAPTURE(by_s);
      CAPTURE(line);
      const std::string stamped = encoded(events, YarpEncoding::kList);
      CHECK(read_log(with_host_time_moved(stamped, line, by_s)).events == events);
      if (line == 0) continue;
      const ReadLog plain =
          read_log(with_host_time_moved(encoded(events, YarpEncoding::kPlain), line, by_s));
      REQUIRE(plain.events.size() == events.size());
      for (std::size_t i = 0; i < events.size(); ++i) {
        REQUIRE(std::abs(plain.events[i].t_us - events[i].t_us) <= 1100);
      }
    }
  }
}

TEST_CASE(
    "without stamps the host's clock measures a pause, and a clock set back changes no event") {
  std::vector<PlainEvent> events = random_events(20);
  for (std::size_t i = 10 * kEventsInPacket; i < events.size(); ++i) events[i].t_us += 30'000'000;
  const ReadLog pause = read_log(encoded(events, YarpEncoding::kPlain));
  REQUIRE(pause.events.size() == events.size());
  CHECK(std::abs(pause.events.back().t_us - events.back().t_us) <= 50);
  CHECK(pause.warnings.empty());
  for (std::size_t i = 10 * kEventsInPacket; i < events.size(); ++i) events[i].t_us -= 60'000'000;
  const ReadLog back = read_log(encoded(events, YarpEncoding::kPlain));
  REQUIRE(back.events.size() == events.size());
  CHECK(std::abs(back.events.back().t_us - (events.back().t_us + 30'000'000)) <= 100);
}

TEST_CASE("truncated lines, lines of other sensors and short lines do not change the encoding") {
  const std::vector<PlainEvent> events = random_events(50);
  for (const std::uint32_t first : {383'033'170U, 1000U}) {
    const std::string text = encoded(events, YarpEncoding::kStamped, first);
    const std::size_t third = text.find('\n', text.find('\n') + 1) + 1;
    const std::size_t fourth = text.find('\n', third) + 1;
    // 8 whole bytes at least, and some of them escaped.
    const std::string cut = text.substr(0, third + 60) + '\n' + text.substr(fourth);
    const ReadLog log = read_log(cut);
    CHECK(log.events.size() > events.size() - kEventsInPacket);
    CHECK(log.events.back() == events.back());
    CHECK(log.counters.malformed_words >= 1);
    CHECK(log.counters.truncated_bytes == 0);
    std::string samples;
    for (int i = 0; i < 300; ++i) samples += "1 1569859362.0 IMUS (1 2 3)\n";
    CHECK(read_log(samples + text).events == events);
    CHECK(read_log(text.substr(0, text.find('\n'))).events.size() == kEventsInPacket);
  }
  // In the order of a sensor that is read out row by row.
  std::vector<PlainEvent> sorted = events;
  std::sort(sorted.begin(), sorted.end(), [](const PlainEvent& a, const PlainEvent& b) {
    return std::pair(a.y, a.x) < std::pair(b.y, b.x);
  });
  for (std::size_t i = 0; i < sorted.size(); ++i)
    sorted[i].t_us = static_cast<std::int64_t>(50 * i);
  CHECK(read_log(encoded(sorted, YarpEncoding::kPlain)).events.size() == sorted.size());
}

TEST_CASE("addresses beyond the sensor, broken lines and odd values are counted") {
  const std::vector<PlainEvent> events = random_events(3);
  const std::string text = encoded(events, YarpEncoding::kList);
  const ReadLog small = read_log(text, {.sensor = {200, 100}});
  CHECK(small.counters.outside_sensor > 0);
  CHECK(small.counters.outside_sensor + small.counters.events == 60);

  const ReadLog broken = read_log(text + "19900 AE (1 2)\n\nnonsense\n" +
                                  "19901 1569859363.2 AE (383150000)\n"
                                  "19902 1569859363.2 AE (383150000 x 383150100 4194308)\n"
                                  "19903 1569859363.2 AE 10\n");
  CHECK(broken.events.size() == 61);
  CHECK(broken.counters.malformed_words == 5);
}

TEST_CASE("a line longer than a buffer is read, and one longer than any packet is skipped") {
  const std::vector<PlainEvent> events = random_events(500);
  YarpLogEncoder encoder(YarpEncoding::kStamped, {0});
  encoder.add(packet_of(events), 500'000);
  const std::string text = encoder.text();
  REQUIRE(text.size() > 66'000);
  CHECK(read_log(text).events == events);
  const ReadLog log = read_log(text + std::string(17 << 20, '7') + "\n" + text);
  CHECK(log.counters.malformed_words == 1);
  CHECK(log.counters.events + log.counters.backwards == 2 * 10'000);
}

TEST_CASE("a YARP log with a damaged start needs its format") {
  const std::string text = encoded(random_events(3), YarpEncoding::kStamped);
  CHECK(
      read_log("2 rubbish\n3 more\n4\n" + text, {.from = "yarp", .sensor = kAtis}).events.size() ==
      60);
}

TEST_CASE("a YARP log's sensor is taken from its events where nothing else tells it") {
  const TemporaryFolder folder;
  for (const YarpEncoding encoding :
       {YarpEncoding::kList, YarpEncoding::kStamped, YarpEncoding::kPlain}) {
    const std::string text = encoded(random_events(3), encoding);
    write_text(folder / "data.log", text);
    const auto reader = open_event_file(folder / "data.log");
    CHECK(reader->sensor_size() == kAtis);
    CHECK(read_all(*reader) == read_log(text).events);
    CHECK(contains(reader->warnings().at(0), "took 304 x 240"));
  }
}

TEST_CASE("the real ball's log has the events of its manifest") {
  const auto recordings = recordings_folder();
  if (!recordings) return;
  const auto reader = open_event_file(
      *recordings / "real_ball" / "bouncing_ball_atis_304x240.yarp.log", {.sensor = kAtis});
  const std::vector<PlainEvent> events = read_all(*reader);
  REQUIRE(events.size() == 24112);
  CHECK(events.front() == PlainEvent{0, 12, 178, 0});
  CHECK(events.back().t_us == 7'299'670);
  CHECK(reader->warnings().empty());
}

}  // namespace puck
