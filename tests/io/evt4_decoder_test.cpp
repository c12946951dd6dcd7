// No recording in EVT4 was to be had: these bytes are written from its specification.
#include "common/io/evt4_decoder.h"

#include <random>

#include <doctest/doctest.h>

#include "tests/io/io_fixtures.h"

namespace puck {
namespace {

constexpr SensorSize kEvt4Sensor{640, 480};

std::uint32_t evt4_time(std::uint32_t high) { return 0xe0000000U | high; }
std::uint32_t evt4_event(std::uint32_t type, std::uint32_t low, std::uint32_t x, std::uint32_t y) {
  return type << 28 | low << 22 | x << 11 | y;
}

TEST_CASE("EVT4 words become events and vectors of events") {
  Evt4Decoder decoder(kEvt4Sensor);
  const auto events = decode_all(
      decoder,
      bytes_of<std::uint32_t>({evt4_time(10), evt4_event(0xb, 5, 639, 479),
                               evt4_event(0xa, 63, 0, 0), 0xffffffff, evt4_time(11),
                               evt4_event(0xd, 0, 7, 8), 0x80000001, evt4_event(0xc, 1, 600, 9),
                               0xf0000000, evt4_event(0x9, 1, 0, 0), evt4_event(0x6, 1, 0, 0)}));
  CHECK(events == std::vector<PlainEvent>{{645, 639, 479, 1},
                                          {703, 0, 0, 0},
                                          {704, 7, 8, 1},
                                          {704, 38, 8, 1},
                                          {705, 628, 9, 0},
                                          {705, 629, 9, 0},
                                          {705, 630, 9, 0},
                                          {705, 631, 9, 0}});
  CHECK(decoder.counters().malformed_words == 0);
}

TEST_CASE("EVT4 events do not depend on the division of the stream") {
  std::mt19937 random(5);
  std::vector<std::uint32_t> words;
  for (std::uint32_t i = 0; i < 300; ++i) {
    words.push_back(evt4_time(i));
    words.push_back(evt4_event(0xa + (i & 1), i % 64, random() % 660, random() % 490));
    words.push_back(evt4_event(0xc + (i & 1), i % 64, random() % 660, random() % 490));
    words.push_back(static_cast<std::uint32_t>(random()));
    if (i % 50 == 0) words.push_back(0xf0000000);
  }
  const auto bytes = bytes_of(words);
  Evt4Decoder whole(kEvt4Sensor);
  const auto expected = decode_all(whole, bytes);
  REQUIRE(expected.size() > 3000);
  CHECK(whole.counters().malformed_words == 6);
  for (const std::size_t piece : {1, 3, 4, 64}) {
    for (const std::size_t max_events : {1, 33, 1000}) {
      Evt4Decoder decoder(kEvt4Sensor);
      CHECK(decode_all(decoder, bytes, piece, max_events) == expected);
      CHECK(decoder.counters() == whole.counters());
    }
  }
}

}  // namespace
}  // namespace puck
