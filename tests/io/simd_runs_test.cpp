// Every instruction set decodes words and records in runs as they are decoded one by one.
#include <algorithm>
#include <memory>
#include <random>
#include <string>

#include <doctest/doctest.h>

#include "common/io/byte_search.h"
#include "common/io/evt2_decoder.h"
#include "common/io/evt4_decoder.h"
#include "common/io/sorted_events.h"
#include "common/io/stamped_record_decoder.h"
#include "tests/io/io_fixtures.h"
#include "tests/support/simd_targets.h"

namespace puck {
namespace {

// With so many of 1000 words of any kind, and a late or doubtful time now and then.
std::vector<std::uint32_t> random_cd_words(std::mt19937& random, unsigned oddities,
                                           std::uint32_t darker, std::uint32_t time_type) {
  const auto below = [&](std::uint32_t count) {
    return static_cast<std::uint32_t>(random() % count);
  };
  std::vector<std::uint32_t> words;
  std::uint32_t high = 0x0fffffff - below(100);  // It wraps.
  std::uint32_t low_us = 0;
  for (int i = 0; i < 3000; ++i) {
    if (below(1000) < oddities) {
      words.push_back(below(2) == 0 ? static_cast<std::uint32_t>(random())
                                    : time_type << 28 | ((high - below(3)) & 0x0fffffff));
    } else if (i == 0 || below(40) == 0) {
      high = (high + (below(4) == 0 ? 0 : 1)) & 0x0fffffff;
      low_us = 0;
      words.push_back(time_type << 28 | high);
    } else {
      low_us = std::min(63U, low_us + (below(5) == 0 ? 3 : 0));
      words.push_back((darker + below(2)) << 28 | low_us << 22 | below(302) << 11 | below(202));
    }
  }
  return words;
}

std::vector<std::uint64_t> random_records(std::mt19937& random, unsigned oddities) {
  const auto below = [&](std::uint32_t count) {
    return static_cast<std::uint32_t>(random() % count);
  };
  std::vector<std::uint64_t> records;
  std::uint32_t stamp = 0xffffffff - below(5000);  // It wraps.
  for (int i = 0; i < 3000; ++i) {
    stamp += below(4);
    std::uint64_t record =
        std::uint64_t{below(2) << 28 | below(202) << 14 | below(302)} << 32 | stamp;
    if (below(1000) < oddities) {
      record = below(2) == 0 ? random() | std::uint64_t{random()} << 32 : record - below(2000);
    }
    records.push_back(record);
  }
  return records;
}

// `make(sensor)`: a new decoder.
template <typename Make>
void check_runs(std::mt19937& random, const std::vector<std::byte>& bytes, Make make) {
  for (const SensorSize sensor : {SensorSize{300, 200}, SensorSize{2048, 2048}}) {
    for (const std::int64_t reorder_us : {0, 500}) {
      const auto one_by_one = make(sensor, reorder_us);
      // A divided word cannot be part of a run.
      const auto expected = decode_all(*one_by_one, bytes, 1);
      REQUIRE(!expected.empty());
      with_each_simd_target([&](const std::string& target) {
        CAPTURE(target);
        for (const std::size_t piece : {std::size_t{9}, 64 + random() % 500, bytes.size()}) {
          for (const std::size_t max_events : {13, 100, 1 << 20}) {
            const auto decoder = make(sensor, reorder_us);
            REQUIRE(decode_all(*decoder, bytes, piece, max_events) == expected);
            REQUIRE(decoder->counters() == one_by_one->counters());
            REQUIRE(decoder->newest() == one_by_one->newest());
          }
        }
      });
    }
  }
}

TEST_CASE("on every instruction set runs of EVT2 and EVT4 give the events of one by one") {
  std::mt19937 random(6);
  for (const unsigned oddities : {0U, 3U, 30U, 300U}) {
    CAPTURE(oddities);
    for (int round = 0; round < 5; ++round) {
      check_runs(random, bytes_of(random_cd_words(random, oddities, 0x0, 0x8)),
                 [](SensorSize sensor, std::int64_t reorder_us) {
                   return std::make_unique<Evt2Decoder>(sensor, reorder_us);
                 });
      check_runs(random, bytes_of(random_cd_words(random, oddities, 0xA, 0xE)),
                 [](SensorSize sensor, std::int64_t reorder_us) {
                   return std::make_unique<Evt4Decoder>(sensor, reorder_us);
                 });
    }
  }
}

TEST_CASE("on every instruction set runs of stamped records give the events of one by one") {
  std::mt19937 random(7);
  const StampedLayout little{.x = {.mask = 0x3fff},
                             .y = {.shift = 14, .mask = 0x3fff},
                             .polarity = {.shift = 28, .mask = 1}};
  StampedLayout big{.is_big_endian = true,
                    .stamp_bits = 31,
                    .other_bits = 0x80000000U,
                    .x = {.mask = 0x3ff, .is_mirrored = true, .last = 299},
                    .y = {.shift = 14, .mask = 0xff, .is_mirrored = true, .last = 199},
                    .polarity = {.shift = 28, .mask = 1, .is_mirrored = true, .last = 1}};
  for (const unsigned oddities : {0U, 3U, 30U, 300U}) {
    CAPTURE(oddities);
    for (int round = 0; round < 5; ++round) {
      std::vector<std::byte> bytes = bytes_of(random_records(random, oddities));
      const auto make = [](const StampedLayout& layout) {
        return [layout](SensorSize sensor, std::int64_t reorder_us) {
          return std::make_unique<StampedRecordDecoder>(layout, sensor, reorder_us);
        };
      };
      check_runs(random, bytes, make(little));
      for (std::size_t i = 0; i < bytes.size(); i += 8) {
        std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(i),
                     bytes.begin() + static_cast<std::ptrdiff_t>(i + 8));
      }
      check_runs(random, bytes, make(big));
    }
  }
}

TEST_CASE("on every instruction set an event out of order is found wherever it is") {
  with_each_simd_target([](const std::string& target) {
    CAPTURE(target);
    for (const std::size_t count :
         {std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{70}}) {
      std::vector<Event> events(count);
      for (std::size_t i = 0; i < count; ++i) {
        events[i].offset_us = 0x7fffffe0U + static_cast<std::uint32_t>(i / 3);
        events[i].x = static_cast<std::uint16_t>(1000 - i);
      }
      CHECK(are_sorted(events));
      for (std::size_t i = 1; i < count; ++i) {
        CAPTURE(i);
        std::vector<Event> disturbed = events;
        disturbed[i - 1].offset_us = disturbed[i].offset_us + 1;
        CHECK(!are_sorted(disturbed));
      }
    }
  });
}

TEST_CASE("on every instruction set a text is found among bytes, also where the end cuts it off") {
  with_each_simd_target([](const std::string& target) {
    CAPTURE(target);
    const std::string text = "% date ";
    for (std::size_t at = 0; at < 300; at += 7) {
      CAPTURE(at);
      std::string bytes(300, '%');
      bytes[5] = ' ';
      bytes.replace(at, text.size(), text);
      bytes.resize(300);
      CHECK(find_start_of(text, std::as_bytes(std::span(bytes))) == at);
    }
    const std::string none(300, ' ');
    CHECK(find_start_of(text, std::as_bytes(std::span(none))) == 300);
    CHECK(find_start_of(text, {}) == 0);
  });
}

}  // namespace
}  // namespace puck
