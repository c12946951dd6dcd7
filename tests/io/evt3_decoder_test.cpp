#include "common/io/evt3_decoder.h"

#include <random>

#include <doctest/doctest.h>

#include "tests/io/io_fixtures.h"
#include "tests/support/simd_targets.h"

namespace puck {
namespace {

constexpr SensorSize kHdSensor{1280, 720};

std::uint16_t word(unsigned type, unsigned payload) {
  return static_cast<std::uint16_t>((type << 12) | payload);
}
std::uint16_t row(unsigned y) { return word(0x0, y); }
std::uint16_t column(unsigned polarity, unsigned x) { return word(0x2, (polarity << 11) | x); }
std::uint16_t base(unsigned polarity, unsigned x) { return word(0x3, (polarity << 11) | x); }
std::uint16_t vector12(unsigned mask) { return word(0x4, mask); }
std::uint16_t vector8(unsigned mask) { return word(0x5, mask); }
std::uint16_t low(unsigned us) { return word(0x6, us); }
std::uint16_t high(unsigned value) { return word(0x8, value); }

std::vector<PlainEvent> decode(Evt3Decoder& decoder, const std::vector<std::uint16_t>& words) {
  return decode_all(decoder, bytes_of(words));
}

TEST_CASE("EVT3 words become events with time, place and polarity") {
  Evt3Decoder decoder(kHdSensor);
  const auto events =
      decode(decoder, {high(2), low(100), row(719), column(1, 1279), column(0, 0), low(101), row(0),
                       column(1, 5), high(3), column(1, 6), low(1), column(1, 7)});
  CHECK(events == std::vector<PlainEvent>{{8292, 1279, 719, 1},
                                          {8292, 0, 719, 0},
                                          {8293, 5, 0, 1},
                                          {12288, 6, 0, 1},
                                          {12289, 7, 0, 1}});
  CHECK(decoder.counters().dropped() == 0);
}

TEST_CASE("EVT3 vectors advance their base by their width") {
  Evt3Decoder decoder(kHdSensor);
  const auto events = decode(decoder, {high(0), row(3), base(1, 64), vector12(0x801),
                                       vector12(0x001), vector8(0x80), vector12(0x001)});
  CHECK(events == std::vector<PlainEvent>{
                      {0, 64, 3, 1}, {0, 75, 3, 1}, {0, 76, 3, 1}, {0, 95, 3, 1}, {0, 96, 3, 1}});
}

TEST_CASE("a repeated EVT3 time word keeps the low part") {
  Evt3Decoder decoder(kHdSensor);
  const auto events = decode(decoder, {high(1), low(7), row(0), high(1), column(1, 1)});
  CHECK(events == std::vector<PlainEvent>{{4103, 1, 0, 1}});
}

TEST_CASE("EVT3 events do not depend on the division of the stream or the size of packets") {
  std::vector<std::uint16_t> words;
  for (unsigned i = 0; i < 100; ++i) {
    words.insert(words.end(), {high(i), low(i), row(i), column(1, i), base(0, 32 * (i % 8)),
                               vector12(0xfff), vector12(0x0f0), vector8(0xff)});
  }
  const auto bytes = bytes_of(words);
  Evt3Decoder whole(kHdSensor);
  const auto expected = decode_all(whole, bytes);
  REQUIRE(expected.size() == 100 * 25);
  for (const std::size_t piece : {1, 3, 16, 1000}) {
    for (const std::size_t max_events : {1, 5, 12, 1000}) {
      Evt3Decoder decoder(kHdSensor);
      CHECK(decode_all(decoder, bytes, piece, max_events) == expected);
    }
  }
}

TEST_CASE("EVT3 packets never exceed the requested number of events, even within a vector") {
  Evt3Decoder decoder(kHdSensor);
  const auto bytes = bytes_of<std::uint16_t>({high(0), row(0), base(1, 0), vector12(0xfff)});
  EventPacket packet;
  CHECK(decoder.decode(bytes, packet, 5) == bytes.size());
  CHECK(packet.events.size() == 5);
  CHECK(decoder.has_backlog());
  packet.events.clear();
  decoder.decode({}, packet, 100);
  CHECK(packet.events.size() == 7);
  CHECK_FALSE(decoder.has_backlog());
}

TEST_CASE("EVT3 events before time, row or vector base are known are dropped and counted") {
  Evt3Decoder decoder(kHdSensor);
  const auto events =
      decode(decoder, {column(1, 1), row(0), column(1, 2), vector12(0x00f), high(0), column(1, 3)});
  CHECK(events == std::vector<PlainEvent>{{0, 3, 0, 1}});
  CHECK(decoder.counters().before_start == 6);
}

TEST_CASE("EVT3 events outside the sensor are dropped and counted") {
  Evt3Decoder decoder(kHdSensor);
  CHECK(decode(decoder, {high(0), row(720), column(1, 0), row(0), column(1, 1280), base(1, 1278),
                         vector12(0xfff)})
            .size() == 2);
  CHECK(decoder.counters().outside_sensor == 12);
}

TEST_CASE("EVT3 words of unknown types are counted, triggers and the like are not") {
  Evt3Decoder decoder(kHdSensor);
  CHECK(decode(decoder, {high(0), word(0x1, 0), word(0x9, 0), word(0xb, 0), word(0xc, 0),
                         word(0xa, 1), word(0xe, 2), word(0xf, 3), word(0x7, 4), word(0xd, 5)})
            .empty());
  CHECK(decoder.counters().malformed_words == 4);
}

TEST_CASE("EVT3 time continues across its wrap after 2^24 µs") {
  Evt3Decoder decoder(kHdSensor);
  const auto events = decode(decoder, {high(4095), low(4095), row(0), column(1, 1), high(0),
                                       column(1, 2), high(1), low(5), column(1, 3)});
  CHECK(events ==
        std::vector<PlainEvent>{{16777215, 1, 0, 1}, {16777216, 2, 0, 1}, {16781317, 3, 0, 1}});
}

TEST_CASE("a pause with time words decodes to its full length") {
  Evt3Decoder decoder(kHdSensor);
  const auto events = decode(decoder, {high(0), row(0), column(1, 1), high(1500), high(3000),
                                       high(400), high(1900), high(1900), low(3), column(1, 2)});
  REQUIRE(events.size() == 2);
  CHECK(events[1].t_us == (std::int64_t{4096 + 1900} << 12) + 3);
}

TEST_CASE("a wrap with a jump is distinguished from a clock that was set back") {
  Evt3Decoder wrapped(kHdSensor);
  CHECK(
      decode(wrapped, {high(3000), row(0), column(1, 1), high(100), low(1), column(1, 2)}).back() ==
      PlainEvent{(std::int64_t{4196} << 12) + 1, 2, 0, 1});
  Evt3Decoder set_back(kHdSensor);
  CHECK(
      decode(set_back, {high(300), row(0), column(1, 1), high(100), low(1), column(1, 2)}).size() ==
      1);
  CHECK(set_back.counters().backwards == 1);
}

TEST_CASE("a single flipped bit in a time word changes no event's time") {
  for (const unsigned glitch : {11u, 523u, 2057u, 1u}) {
    CAPTURE(glitch);
    Evt3Decoder decoder(kHdSensor);
    const auto events =
        decode(decoder, {high(9), low(1), row(0), column(1, 1), high(glitch), low(2), column(1, 2),
                         high(9), low(3), column(1, 3), high(10), low(4), column(1, 4)});
    CHECK(events == std::vector<PlainEvent>{
                        {36865, 1, 0, 1}, {36866, 2, 0, 1}, {36867, 3, 0, 1}, {40964, 4, 0, 1}});
    CHECK(decoder.counters().time_glitches == 1);
  }
}

TEST_CASE("events after a jump are released without another time word, at the latest at the end") {
  Evt3Decoder decoder(kHdSensor);
  const auto bytes = bytes_of<std::uint16_t>({high(0), row(0), high(500), low(1), column(1, 2)});
  EventPacket packet;
  decoder.decode(bytes, packet, 100);
  CHECK(packet.empty());
  decoder.finish();
  decoder.decode({}, packet, 100);
  REQUIRE(packet.events.size() == 1);
  CHECK(packet.start.us == (500 << 12) + 1);
}

TEST_CASE("the number of held-back events is bounded") {
  Evt3Decoder decoder(kHdSensor);
  std::vector<std::uint16_t> words{high(0), row(0), high(500)};
  words.insert(words.end(), 70000, column(1, 2));
  EventPacket packet;
  std::size_t used = 0;
  const auto bytes = bytes_of(words);
  while (used < bytes.size()) {
    used += decoder.decode(std::span(bytes).subspan(used), packet, 100000);
  }
  CHECK(packet.events.size() == 70000);
}

/// A camera's words, of which `oddities` in 1000 are arbitrary.
std::vector<std::uint16_t> random_words(std::mt19937& random, unsigned oddities) {
  std::vector<std::uint16_t> words;
  unsigned time = 0;
  const auto below = [&](unsigned count) { return static_cast<unsigned>(random() % count); };
  while (words.size() < 3000) {
    if (below(1000) < oddities) {
      words.push_back(static_cast<std::uint16_t>(random()));
      continue;
    }
    const unsigned kind = below(32);
    if (kind < 1) {
      words.push_back(high(time >> 12 & 0xfff));
    } else if (kind < 4) {
      time += below(200);
      words.push_back(low(time & 0xfff));
    } else if (kind < 10) {
      words.push_back(row(below(205)));
    } else if (kind < 22) {
      words.push_back(column(below(2), below(305)));
    } else if (kind < 25) {
      words.push_back(base(below(2), below(305)));
    } else if (kind < 28) {
      words.push_back(vector12(below(4096)));
    } else {
      words.push_back(vector8(below(256)));
    }
  }
  return words;
}

TEST_CASE(
    "on every instruction set EVT3 words in runs give the same events and counts as one by one") {
  std::mt19937 random(5);
  for (const unsigned oddities : {0U, 2U, 20U, 300U}) {
    for (int round = 0; round < 10; ++round) {
      CAPTURE(oddities);
      CAPTURE(round);
      const auto bytes = bytes_of(random_words(random, oddities));
      // A sensor that ends within vectors, and one that contains every coordinate.
      for (const SensorSize sensor : {SensorSize{300, 200}, SensorSize{2048, 2048}}) {
        Evt3Decoder one_by_one(sensor);
        // A divided word cannot be part of a run.
        const auto expected = decode_all(one_by_one, bytes, 1);
        REQUIRE(!expected.empty());
        with_each_simd_target([&](const std::string& target) {
          CAPTURE(target);
          for (const std::size_t piece :
               {std::size_t{2}, std::size_t{7}, 64 + random() % 500, bytes.size()}) {
            for (const std::size_t max_events : {13, 100, 1 << 20}) {
              Evt3Decoder decoder(sensor);
              REQUIRE(decode_all(decoder, bytes, piece, max_events) == expected);
              REQUIRE(decoder.counters() == one_by_one.counters());
            }
          }
        });
      }
    }
  }
}

TEST_CASE("EVT3 vectors at the edge of the largest sensor keep polarity and place") {
  Evt3Decoder decoder({2048, 2048});
  const auto events = decode(
      decoder, {high(0), row(2047), column(1, 1), base(0, 2036), vector12(0x801), vector12(0x001),
                base(1, 2040), vector8(0x80), vector8(0x01), column(0, 2047)});
  CHECK(events == std::vector<PlainEvent>{{0, 1, 2047, 1},
                                          {0, 2036, 2047, 0},
                                          {0, 2047, 2047, 0},
                                          {0, 2047, 2047, 1},
                                          {0, 2047, 2047, 0}});
  CHECK(decoder.counters().outside_sensor == 2);
}

TEST_CASE("EVT3 events more than an hour after the packet's start begin the next packet") {
  // 2^32 µs are 256 wraps of the format's time and some more.
  std::vector<std::uint16_t> words{high(0), row(0), column(1, 1), column(1, 2)};
  for (unsigned step = 1; step <= 0x100001; ++step) words.push_back(high(step & 0xfff));
  words.insert(words.end(), {column(1, 3), column(1, 4)});
  Evt3Decoder decoder(kHdSensor);
  const auto bytes = bytes_of(words);
  EventPacket packet;
  std::size_t used = decoder.decode(bytes, packet, 100);
  CHECK(packet.events.size() == 2);
  packet.events.clear();
  used += decoder.decode(std::span(bytes).subspan(used), packet, 100);
  CHECK(used == bytes.size());
  REQUIRE(packet.events.size() == 2);
  CHECK(packet.newest().us == std::int64_t{0x100001} << 12);
}

TEST_CASE("any bytes decode without an event outside the sensor or out of order") {
  std::uint32_t state = 12345;
  std::vector<std::byte> bytes;
  for (int i = 0; i < 200000; ++i) {
    state = state * 1664525u + 1013904223u;
    bytes.push_back(static_cast<std::byte>(state >> 24));
  }
  Evt3Decoder decoder({300, 200});
  const auto events = decode_all(decoder, bytes, 777, 100);
  REQUIRE(!events.empty());
  std::int64_t newest_us = 0;
  for (const PlainEvent& event : events) {
    REQUIRE(event.t_us >= newest_us);
    REQUIRE(event.x < 300);
    REQUIRE(event.y < 200);
    newest_us = event.t_us;
  }
}

}  // namespace
}  // namespace puck
