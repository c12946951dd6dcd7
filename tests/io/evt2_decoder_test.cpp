#include "common/io/evt2_decoder.h"

#include <random>

#include <doctest/doctest.h>

#include "tests/io/io_fixtures.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{640, 480};

std::uint32_t time_high(std::uint32_t high) { return 0x80000000u | high; }
std::uint32_t event(std::uint32_t polarity, std::uint32_t low, std::uint32_t x, std::uint32_t y) {
  return (polarity << 28) | (low << 22) | (x << 11) | y;
}

std::vector<PlainEvent> decode(Evt2Decoder& decoder, const std::vector<std::uint32_t>& words) {
  return decode_all(decoder, bytes_of(words));
}

TEST_CASE("EVT2 words become events with time, place and polarity") {
  Evt2Decoder decoder(kSensor);
  const auto events = decode(decoder, {time_high(10), event(1, 5, 639, 479), event(0, 63, 0, 0),
                                       time_high(11), event(1, 0, 7, 8)});
  CHECK(events == std::vector<PlainEvent>{{645, 639, 479, 1}, {703, 0, 0, 0}, {704, 7, 8, 1}});
  CHECK(decoder.counters().events == 3);
  CHECK(decoder.counters().dropped() == 0);
}

TEST_CASE("EVT2 events do not depend on the division of the stream") {
  std::vector<std::uint32_t> words;
  for (std::uint32_t i = 0; i < 200; ++i) {
    words.push_back(time_high(i));
    words.push_back(event(i & 1, i % 64, i, i));
  }
  const auto bytes = bytes_of(words);
  Evt2Decoder whole(kSensor);
  const auto expected = decode_all(whole, bytes);
  REQUIRE(expected.size() == 200);
  for (const std::size_t piece : {1, 2, 3, 5, 7, 64}) {
    for (const std::size_t max_events : {1, 3, 1000}) {
      Evt2Decoder decoder(kSensor);
      CHECK(decode_all(decoder, bytes, piece, max_events) == expected);
    }
  }
}

TEST_CASE("EVT2 events before the first time word are dropped and counted") {
  Evt2Decoder decoder(kSensor);
  CHECK(decode(decoder, {event(1, 0, 1, 1), event(1, 0, 1, 1), time_high(0), event(1, 0, 1, 1)})
            .size() == 1);
  CHECK(decoder.counters().before_start == 2);
}

TEST_CASE("EVT2 events outside the sensor are dropped and counted") {
  Evt2Decoder decoder(kSensor);
  CHECK(decode(decoder, {time_high(0), event(1, 0, 640, 0), event(1, 0, 0, 480),
                         event(1, 0, 2047, 2047), event(1, 0, 639, 479)})
            .size() == 1);
  CHECK(decoder.counters().outside_sensor == 3);
}

TEST_CASE("EVT2 words of unknown types are counted, triggers and monitoring words are not") {
  Evt2Decoder decoder(kSensor);
  CHECK(decode(decoder, {time_high(0), 0x20000000u, 0xB0000000u, 0xA0000001u, 0xE0000014u,
                         0xF0000001u, 0xD0000000u, event(0, 1, 2, 3)}) ==
        std::vector<PlainEvent>{{1, 2, 3, 0}});
  CHECK(decoder.counters().malformed_words == 2);
}

TEST_CASE("EVT2 time continues across its wrap after 2^34 µs") {
  Evt2Decoder decoder(kSensor);
  const auto events = decode(decoder, {time_high(0x0fffffff), event(1, 63, 1, 1), time_high(0),
                                       event(1, 0, 1, 1), time_high(1), event(1, 0, 1, 1)});
  REQUIRE(events.size() == 3);
  CHECK(events[0].t_us == (std::int64_t{1} << 34) - 1);
  CHECK(events[1].t_us == (std::int64_t{1} << 34));
  CHECK(events[2].t_us == (std::int64_t{1} << 34) + 64);
}

TEST_CASE("EVT2 events older than the newest one are dropped and counted") {
  Evt2Decoder decoder(kSensor);
  const auto events = decode(decoder, {time_high(5), event(1, 9, 1, 1), event(1, 8, 2, 2),
                                       event(1, 9, 3, 3), event(1, 10, 4, 4)});
  CHECK(events == std::vector<PlainEvent>{{329, 1, 1, 1}, {329, 3, 3, 1}, {330, 4, 4, 1}});
  CHECK(decoder.counters().backwards == 1);
}

TEST_CASE("a truncated word at the end is counted") {
  Evt2Decoder decoder(kSensor);
  auto bytes = bytes_of<std::uint32_t>({time_high(0), event(1, 0, 1, 1), event(1, 0, 2, 2)});
  bytes.pop_back();
  CHECK(decode_all(decoder, bytes).size() == 1);
  CHECK(decoder.counters().truncated_bytes == 3);
}

TEST_CASE("a packet ends before an event more than 2^32 - 1 µs after its start") {
  Evt2Decoder decoder(kSensor);
  const std::uint32_t later = 1u << 26;  // 2^32 µs
  const auto bytes =
      bytes_of<std::uint32_t>({time_high(0), event(1, 0, 1, 1), time_high(later), time_high(later),
                               event(1, 0, 2, 2), event(1, 1, 3, 3)});
  EventPacket packet;
  std::size_t used = decoder.decode(bytes, packet, 100);
  CHECK(packet.events.size() == 1);
  CHECK(decoder.has_backlog());
  packet.events.clear();
  used += decoder.decode(std::span(bytes).subspan(used), packet, 100);
  CHECK(used == bytes.size());
  REQUIRE(packet.events.size() == 2);
  CHECK(packet.start.us == std::int64_t{1} << 32);
  CHECK(packet.events[1].offset_us == 1);
}

TEST_CASE("EVT2 words in runs give the same events and counts as one by one") {
  std::mt19937 random(6);
  const auto below = [&](std::uint32_t count) {
    return static_cast<std::uint32_t>(random() % count);
  };
  for (const std::uint32_t oddities : {0U, 5U, 300U}) {
    CAPTURE(oddities);
    std::vector<std::uint32_t> words;
    std::uint32_t time = 0;
    while (words.size() < 5000) {
      time += below(3);
      if (below(1000) < oddities) {
        words.push_back(static_cast<std::uint32_t>(random()));
      } else if (below(40) == 0) {
        words.push_back(time_high(time >> 6));
      } else {
        words.push_back(event(below(2), time & 63, below(642), below(482)));
      }
    }
    const auto bytes = bytes_of(words);
    Evt2Decoder one_by_one(kSensor);
    // A divided word cannot be part of a run.
    const auto expected = decode_all(one_by_one, bytes, 1);
    REQUIRE(!expected.empty());
    for (const std::size_t piece :
         {std::size_t{4}, std::size_t{7}, 64 + random() % 500, bytes.size()}) {
      for (const std::size_t max_events : {1, 2, 100, 1 << 20}) {
        Evt2Decoder decoder(kSensor);
        REQUIRE(decode_all(decoder, bytes, piece, max_events) == expected);
        REQUIRE(decoder.counters() == one_by_one.counters());
      }
    }
  }
}

}  // namespace
}  // namespace puck
