#include "common/io/ecf_codec.h"

#include <algorithm>
#include <random>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

namespace puck {
namespace {

std::vector<std::byte> bytes_from(const std::vector<int>& numbers) {
  std::vector<std::byte> bytes;
  for (const int number : numbers) bytes.push_back(static_cast<std::byte>(number));
  return bytes;
}

std::vector<EcfEvent> decoded(const std::vector<std::byte>& chunk) {
  std::vector<EcfEvent> events;
  decode_ecf(chunk, events);
  return events;
}

// The header's two lowest bits.
int form_of(const std::vector<std::byte>& chunk) { return std::to_integer<int>(chunk.at(0)) & 3; }

TEST_CASE("ECF: a chunk made by hand from the specification, y, x and polarity in 24 bits") {
  // Two events at 100 µs and one 0x12 later: (1, 2, 1), (3, 4, 0), (5, 6, 1).
  const auto chunk =
      bytes_from({3 << 2 | 2, 0,    0,    0,    100, 0, 0, 0, 0, 0, 0, 0,  // Header, time.
                  0x02,       0xf2, 0xf1, 0x01,                            // Steps and runs.
                  0x06,       0x03, 0x20, 0x00,                            // 0x002003, 0x06
                  0x0b,       0x60, 0x40, 0x00,                            // 0x0040, 0x600b
                  0x00,       0x00, 0x00, 0x00});
  CHECK(decoded(chunk) == std::vector<EcfEvent>{{1, 2, 1, 100}, {3, 4, 0, 100}, {5, 6, 1, 118}});
}

TEST_CASE("ECF: a chunk made by hand, rows in runs, columns with masks, polarities in runs") {
  // Row 7: 10, 11, 15; row 8: 10. Polarity 1, 1, 1, 0; all at 5 µs.
  const auto chunk = bytes_from({4 << 2,
                                 0,
                                 0,
                                 0,
                                 5,
                                 0,
                                 0,
                                 0,
                                 0,
                                 0,
                                 0,
                                 0,     //
                                 0x04,  //
                                 (7 << 5 | 3) & 0xff,
                                 7 << 5 >> 8,
                                 (8 << 5 | 1) & 0xff,
                                 1,
                                 (10 << 5 & 0xff) | 0x11,
                                 10 << 5 >> 8,
                                 10 << 5 & 0xff,
                                 1,
                                 0x83,
                                 0x01});
  CHECK(decoded(chunk) ==
        std::vector<EcfEvent>{{10, 7, 1, 5}, {11, 7, 1, 5}, {15, 7, 1, 5}, {10, 8, 0, 5}});
}

TEST_CASE("ECF: a chunk made by hand, rows in runs, columns and polarities in 12 bits") {
  // Row 1, columns 0x123, 0x456, 0x7ff, 1, polarities 1, 0, 1, 0: 0x247, 0x8ac, 0xfff, 0x002.
  const auto chunk =
      bytes_from({4 << 2 | 1, 0,          0,    0,    5,    0,   0, 0, 0, 0, 0, 0,  //
                  0x04,       1 << 5 | 4, 0,                                        //
                  0x7c,       0x24,       0xff, 0x8a, 0x02, 0xf0});
  CHECK(decoded(chunk) ==
        std::vector<EcfEvent>{{0x123, 1, 1, 5}, {0x456, 1, 0, 5}, {0x7ff, 1, 1, 5}, {1, 1, 0, 5}});
}

// Events whose smallest form is the one asked for, with runs below, at and above the limits.
std::vector<EcfEvent> events_of_form(int form, std::size_t count, std::mt19937& random) {
  std::vector<EcfEvent> events(count);
  std::int64_t t_us = static_cast<std::int64_t>(random());
  std::uint16_t y = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (random() % 20 == 0) t_us += static_cast<std::int64_t>(random() % 5000);
    if (random() % 1000 == 0) t_us += std::int64_t{1} << 40;
    const bool new_row = form == 2 || random() % 40 == 0;
    if (new_row) y = static_cast<std::uint16_t>(random() % 2048);
    const bool scatters = form != 0 || new_row || i == 0;
    const auto x = static_cast<std::uint16_t>(scatters ? random() % 1500 : events[i - 1].x + 1);
    const auto polarity = static_cast<std::int16_t>(form == 0 ? i / 200 % 2 : random() % 2);
    events[i] = {std::min<std::uint16_t>(x, 2047), y, polarity, t_us};
  }
  return events;
}

TEST_CASE("ECF: what is packed is unpacked, in the smallest of the three forms") {
  std::mt19937 random(1);
  std::vector<std::byte> chunk;
  for (const int form : {0, 1, 2}) {
    for (const std::size_t count : {1000, 16384, 65535}) {
      const auto events = events_of_form(form, count, random);
      encode_ecf(events, chunk);
      CHECK(form_of(chunk) == form);
      CHECK(decoded(chunk) == events);
    }
  }
  for (std::size_t count = 0; count < 40; ++count) {
    const auto events = events_of_form(static_cast<int>(count % 3), count, random);
    encode_ecf(events, chunk);
    CHECK(decoded(chunk) == events);
  }
}

TEST_CASE("ECF: long runs of one time, row and polarity") {
  std::vector<EcfEvent> events(65535, EcfEvent{5, 6, 1, -3});
  std::vector<std::byte> chunk;
  encode_ecf(events, chunk);
  CHECK(decoded(chunk) == events);
  for (const std::size_t run : {14, 15, 16, 30, 31, 32, 126, 127, 128}) {
    for (std::size_t i = 0; i < 400; ++i) {
      events[i] = {static_cast<std::uint16_t>(i % 6), static_cast<std::uint16_t>(i / run),
                   static_cast<std::int16_t>(i / run % 2), static_cast<std::int64_t>(i / run)};
    }
    encode_ecf(std::span(events).first(400), chunk);
    CHECK(decoded(chunk) == std::vector<EcfEvent>(events.begin(), events.begin() + 400));
  }
}

TEST_CASE("ECF: a chunk that is cut off anywhere is refused, and names the byte") {
  std::mt19937 random(2);
  for (const int form : {0, 1, 2}) {
    std::vector<std::byte> chunk;
    encode_ecf(events_of_form(form, 200, random), chunk);
    for (std::size_t length = 0; length < chunk.size(); ++length) {
      std::vector<EcfEvent> events(3);
      CHECK_THROWS_AS(decode_ecf(std::span(chunk).first(length), events), std::invalid_argument);
      CHECK(events.empty());
    }
  }
}

TEST_CASE("ECF: any bytes are decoded or refused") {
  std::mt19937 random(3);
  std::vector<EcfEvent> events;
  int refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::vector<std::byte> chunk(random() % 300);
    for (std::byte& byte : chunk) byte = static_cast<std::byte>(random());
    // Mostly few events, so that the parts behind the times are reached.
    if (chunk.size() > 4) chunk[1] = chunk[2] = chunk[3] = std::byte{0};
    try {
      decode_ecf(chunk, events);
      CHECK(events.size() < 64);
    } catch (const std::invalid_argument&) {
      ++refused;
    }
  }
  CHECK(refused > 100);
}

}  // namespace
}  // namespace puck
