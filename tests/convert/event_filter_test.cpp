#include "tools/convert/event_filter.h"

#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/io/io_fixtures.h"

namespace puck {
namespace {

// One event each 1 ms from 5 s on, at (i, 2 i), in packets of three.
std::vector<PlainEvent> filtered(EventFilter& filter, int count = 10) {
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
  EventFilter filter({}, {20, 20});
  CHECK(filtered(filter).size() == 10);
  CHECK(filter.left_out().sum() == 0);
  CHECK(filter.sensor() == SensorSize{20, 20});
}

TEST_CASE("a part counts from the first event; what is outside is counted") {
  EventFilter filter({.from_us = 2000, .length_us = 3000}, {20, 20});
  const auto left = filtered(filter);
  REQUIRE(left.size() == 3);
  CHECK(left.front() == PlainEvent{5'002'000, 2, 4, 0});
  CHECK(left.back() == PlainEvent{5'004'000, 4, 8, 0});
  CHECK(filter.left_out().before == 2);
  // Only of the packet that was read.
  CHECK(filter.left_out().after == 1);
}

TEST_CASE("a crop becomes the sensor, and a rotation turns within it") {
  EventFilter crop({.crop = Region{1, 2, 3, 5}}, {20, 20});
  CHECK(filtered(crop) ==
        std::vector<PlainEvent>{{5'001'000, 0, 0, 1}, {5'002'000, 1, 2, 0}, {5'003'000, 2, 4, 1}});
  CHECK(crop.sensor() == SensorSize{3, 5});
  CHECK(crop.left_out().outside_crop == 7);

  EventFilter turned({.crop = Region{1, 2, 3, 5}, .rotate_180 = true}, {20, 20});
  CHECK(filtered(turned) ==
        std::vector<PlainEvent>{{5'001'000, 2, 4, 1}, {5'002'000, 1, 2, 0}, {5'003'000, 0, 0, 1}});
}

TEST_CASE("a mask is of the sensor before the crop") {
  const std::vector<PixelPlace> hot{{2, 4}};
  EventFilter filter({.crop = Region{1, 2, 3, 5}, .mask = PixelMask({20, 20}, hot)}, {20, 20});
  CHECK(filtered(filter).size() == 2);
  CHECK(filter.left_out().masked == 1);
  CHECK_THROWS_AS(EventFilter({.mask = PixelMask({10, 20}, hot)}, {20, 20}), std::invalid_argument);
}

TEST_CASE("times start at zero with the first event that is left") {
  EventFilter filter({.from_us = 2000, .start_at_zero = true}, {20, 20});
  const auto left = filtered(filter);
  REQUIRE(left.size() == 8);
  CHECK(left.front().t_us == 0);
  CHECK(left.back().t_us == 7000);
}

TEST_CASE("a crop outside the sensor is refused") {
  for (const Region crop : {Region{0, 0, 21, 20}, Region{-1, 0, 5, 5}, Region{5, 5, 0, 3}}) {
    CHECK_THROWS_AS(EventFilter({.crop = crop}, {20, 20}), std::invalid_argument);
  }
}

}  // namespace
}  // namespace puck
