#include "tools/convert/conversion_filter.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include <doctest/doctest.h>

#include "tests/io/io_fixtures.h"

namespace puck {
namespace {

// One event each 1 ms from 5 s on, at (i, 2 i), in packets of three.
std::vector<PlainEvent> filtered(ConversionFilter& filter, int count = 10) {
  std::vector<PlainEvent> events;
  for (int i = 0; i < count; ++i) events.push_back({5'000'000 + 1000 * i, i, 2 * i, i % 2});
  std::vector<PlainEvent> left;
  for (std::size_t i = 0; i < events.size(); i += 3) {
    const auto first = events.begin() + static_cast<std::ptrdiff_t>(i);
    EventPacket packet = packet_of(
        {first, first + static_cast<std::ptrdiff_t>(std::min<std::size_t>(3, events.size() - i))});
    const bool goes_on = filter.apply(packet);
    append_plain(packet, left);
    if (!goes_on) break;
  }
  return left;
}

TEST_CASE("a filter without parameters changes nothing") {
  ConversionFilter filter({}, {20, 20});
  CHECK(filtered(filter).size() == 10);
  CHECK(filter.filtered().sum() == 0);
  CHECK(filter.sensor() == SensorSize{20, 20});
}

TEST_CASE("a part counts from the first event; what is outside is counted") {
  ConversionFilter filter({.from_us = 2000, .length_us = 3000}, {20, 20});
  const auto left = filtered(filter);
  REQUIRE(left.size() == 3);
  CHECK(left.front() == PlainEvent{5'002'000, 2, 4, 0});
  CHECK(left.back() == PlainEvent{5'004'000, 4, 8, 0});
  CHECK(filter.before() == 2);
  // Only of the packet that was read.
  CHECK(filter.after() == 1);
}

TEST_CASE("the part is cut before its events are filtered") {
  ConversionFilter filter({.from_us = 2000, .events = {.crop = Region{0, 0, 20, 10}}}, {20, 20});
  CHECK(filtered(filter).size() == 3);
  CHECK(filter.before() == 2);
  CHECK(filter.filtered().outside_crop == 5);
}

TEST_CASE("times start at zero with the first event that is left") {
  ConversionFilter filter(
      {.from_us = 2000, .start_at_zero = true, .events = {.crop = Region{3, 0, 17, 20}}}, {20, 20});
  const auto left = filtered(filter);
  REQUIRE(left.size() == 7);
  CHECK(left.front() == PlainEvent{0, 3, 6, 1});
  CHECK(left.back().t_us == 6000);
}

}  // namespace
}  // namespace puck
