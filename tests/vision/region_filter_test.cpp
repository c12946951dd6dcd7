#include "common/vision/surface/region_filter.h"

#include <algorithm>
#include <random>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/simd_targets.h"

namespace puck {
namespace {

std::vector<Event> random_events(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Event> events(count);
  for (std::size_t i = 0; i < count; ++i) {
    events[i] = {static_cast<std::uint16_t>(random() % 64),
                 static_cast<std::uint16_t>(random() % 48 & 0x7fffU),
                 static_cast<std::uint16_t>(random() & 1U), static_cast<std::uint32_t>(random())};
  }
  return events;
}

const std::vector<Region> kRegions{
    {10, 5, 20, 30}, {0, 0, 64, 48},   {63, 47, 1, 1},
    {0, 0, 1, 1},    {-9, -9, 20, 15}, {50, 40, 90, 90},
    {70, 5, 9, 9},   {5, 5, 0, 0},     {-30'000, -30'000, 60'000, 60'000}};

}  // namespace

TEST_CASE("every instruction set copies the same events as the plain form") {
  with_each_simd_target([](const std::string& name) {
    CAPTURE(name);
    for (const std::size_t count : {0U, 1U, 3U, 7U, 8U, 9U, 64U, 200U, 1023U}) {
      const auto events = random_events(count, static_cast<unsigned>(count));
      for (const Region& region : kRegions) {
        std::vector<Event> fast(count + kCopySlack);
        std::vector<Event> plain(count + kCopySlack);
        const std::size_t copied = copy_inside(events, region, fast.data());
        REQUIRE(copied == copy_inside_one_by_one(events, region, plain.data()));
        REQUIRE(std::equal(fast.begin(), fast.begin() + static_cast<std::ptrdiff_t>(copied),
                           plain.begin()));
      }
    }
  });
}

TEST_CASE("the events inside a region are handed over, in order, for any number") {
  const auto events = random_events(5000, 3);
  for (const Region& region : kRegions) {
    std::vector<Event> expected;
    for (const Event& event : events) {
      if (region.contains(event.x, event.y)) expected.push_back(event);
    }
    std::vector<Event> used;
    for_inside(events, region, [&](std::span<const Event> inside) {
      CHECK_FALSE(inside.empty());
      used.insert(used.end(), inside.begin(), inside.end());
    });
    CHECK(used == expected);
    CHECK(any_inside(events, region) == !expected.empty());
  }
  const std::vector<Event> last{{1, 1, 0, 0}, {2, 2, 0, 0}, {9, 9, 1, 5}};
  CHECK(any_inside(last, {9, 9, 1, 1}));
  CHECK_FALSE(any_inside(last, {8, 8, 1, 1}));
}

}  // namespace puck
