#include "common/io/evt21_decoder.h"

#include <bit>
#include <random>

#include <doctest/doctest.h>

#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

using Evt21Order = Evt21Decoder::Order;

constexpr SensorSize kGenX320{320, 320};

std::uint64_t evt21_time(std::uint64_t high) { return std::uint64_t{0x8} << 60 | high << 32; }
std::uint64_t evt21_vector(std::uint64_t polarity, std::uint64_t low, std::uint64_t x,
                           std::uint64_t y, std::uint64_t mask) {
  return polarity << 60 | low << 54 | x << 43 | y << 32 | mask;
}

std::vector<PlainEvent> decode_evt21(std::vector<std::uint64_t> words,
                                     Evt21Order order = Evt21Order::kLittle) {
  if (order == Evt21Order::kLegacy) {
    for (std::uint64_t& word : words) word = std::rotl(word, 32);
  }
  Evt21Decoder decoder(kGenX320, order);
  return decode_all(decoder, bytes_of(words));
}

TEST_CASE("EVT2.1 words become up to 32 events of one row, in both orders of their halves") {
  const std::vector<std::uint64_t> words{evt21_time(10), evt21_vector(1, 5, 288, 319, 0x80000001),
                                         evt21_vector(0, 63, 0, 0, 2), evt21_time(11),
                                         evt21_vector(1, 0, 32, 8, 1)};
  const std::vector<PlainEvent> expected{
      {645, 288, 319, 1}, {645, 319, 319, 1}, {703, 1, 0, 0}, {704, 32, 8, 1}};
  CHECK(decode_evt21(words) == expected);
  CHECK(decode_evt21(words, Evt21Order::kLegacy) == expected);
}

TEST_CASE("EVT2.1 bytes of the specification's example are read in the legacy order") {
  // 0x0102030405060708 is stored as 04 03 02 01 08 07 06 05.
  const std::vector<std::byte> bytes = bytes_of<std::uint8_t>(
      {0x00, 0x00, 0x00, 0x80, 0, 0, 0, 0, 0x04, 0x03, 0x02, 0x01, 0x08, 0x07, 0x06, 0x05});
  Evt21Decoder decoder({2048, 2048}, Evt21Order::kLegacy);
  const auto events = decode_all(decoder, bytes);
  REQUIRE(events.size() == static_cast<std::size_t>(std::popcount(0x05060708U)));
  CHECK(events.front() == PlainEvent{4, 64 + 3, 0x304, 0});
}

TEST_CASE("EVT2.1 events do not depend on the division of the stream") {
  std::mt19937 random(3);
  std::vector<std::uint64_t> words;
  for (std::uint64_t i = 0; i < 300; ++i) {
    words.push_back(evt21_time(i));
    words.push_back(evt21_vector(i & 1, i % 64, random() % 11 * 32, random() % 330, random()));
    words.push_back(random() % 8 == 0 ? std::uint64_t{0xA} << 60 : evt21_vector(0, 63, 0, 1, 7));
  }
  const auto bytes = bytes_of(words);
  Evt21Decoder whole(kGenX320, Evt21Order::kLittle);
  const auto expected = decode_all(whole, bytes);
  REQUIRE(expected.size() > 3000);
  CHECK(whole.counters().outside_sensor > 0);
  for (const std::size_t piece : {1, 3, 8, 64}) {
    for (const std::size_t max_events : {1, 33, 1000}) {
      Evt21Decoder decoder(kGenX320, Evt21Order::kLittle);
      CHECK(decode_all(decoder, bytes, piece, max_events) == expected);
      CHECK(decoder.counters() == whole.counters());
    }
  }
}

TEST_CASE("EVT2.1 vectors without events or off their grid count as malformed") {
  Evt21Decoder decoder(kGenX320, Evt21Order::kLittle);
  const auto events = decode_all(
      decoder, bytes_of<std::uint64_t>({evt21_vector(1, 0, 0, 0, 3), evt21_time(0),
                                        evt21_vector(1, 0, 5, 0, 1), evt21_vector(1, 0, 32, 0, 0),
                                        std::uint64_t{0x5} << 60}));
  CHECK(events.empty());
  CHECK(decoder.counters().malformed_words == 3);
  CHECK(decoder.counters().before_start == 2);
}

TEST_CASE("one EVT2.1 time word that falls back is no wrap, and a real wrap goes on") {
  const std::uint64_t last = (1U << 28) - 1;
  const auto at = [](std::uint64_t y) { return evt21_vector(1, 0, 0, y, 1); };
  CHECK(decode_evt21({evt21_time(1000), at(1), evt21_time(2), at(2), evt21_time(1001), at(3)}) ==
        std::vector<PlainEvent>{{64000, 0, 1, 1}, {64000, 0, 2, 1}, {64064, 0, 3, 1}});
  CHECK(decode_evt21({evt21_time(last), at(1), evt21_time(0), at(2), evt21_time(1), at(3)}) ==
        std::vector<PlainEvent>{{static_cast<std::int64_t>(last) * 64, 0, 1, 1},
                                {std::int64_t{1} << 34, 0, 2, 1},
                                {(std::int64_t{1} << 34) + 64, 0, 3, 1}});
}

TEST_CASE("the order of an EVT2.1 file's halves is found where its header lacks it") {
  const TemporaryFolder folder;
  std::vector<std::uint64_t> words;
  for (std::uint64_t i = 0; i < 50; ++i) {
    words.push_back(evt21_time(i));
    words.push_back(evt21_vector(i & 1, 0, 64, i, 0x11));
  }
  const auto file = [&](const char* format, int turn_bits) {
    std::string text =
        std::string("% evt 2.1\n% format EVT21;height=320;width=320") + format + "\n% end\n";
    for (const std::uint64_t word : words) {
      const auto bytes = bytes_of<std::uint64_t>({std::rotl(word, turn_bits)});
      text.append(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    }
    return folder.write("a.raw", text);
  };
  const auto expected = decode_evt21(words);
  CHECK(read_all(*open_event_file(file("", 0))) == expected);
  CHECK(read_all(*open_event_file(file("", 32))) == expected);
  CHECK(read_all(*open_event_file(file(";endianness=legacy", 32))) == expected);
  const auto contradicted = open_event_file(file(";endianness=legacy", 0));
  CHECK(read_all(*contradicted) == expected);
  CHECK(contains(contradicted->warnings().at(0), "time words only in the other order"));
  CHECK(contains(message_of<EventFileError>([&] { open_event_file(file(";endianness=big", 0)); }),
                 "expected little or legacy"));
}

}  // namespace
}  // namespace puck
