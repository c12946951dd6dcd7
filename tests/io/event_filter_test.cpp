#include "common/io/event_filter.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

#include "tests/io/io_fixtures.h"
#include "tests/support/contains.h"

namespace puck {
namespace {

constexpr SensorSize kSmall{8, 6};

/// What a filter leaves of events that come in packets of `size`.
std::vector<PlainEvent> through(EventFilter& filter, const std::vector<PlainEvent>& events,
                                std::size_t size = 3) {
  std::vector<PlainEvent> left;
  for (std::size_t i = 0; i < events.size(); i += size) {
    const auto first = events.begin() + static_cast<std::ptrdiff_t>(i);
    const auto count = static_cast<std::ptrdiff_t>(std::min(size, events.size() - i));
    EventPacket packet = packet_of({first, first + count});
    filter.apply(packet);
    append_plain(packet, left);
  }
  return left;
}

std::vector<PlainEvent> random_events(SensorSize sensor, int count) {
  std::mt19937 random(7);
  std::vector<PlainEvent> events;
  std::int64_t time_us = 1'000'000'000'000;
  for (int i = 0; i < count; ++i) {
    time_us += random() % 40;
    events.push_back({time_us, static_cast<int>(random() % static_cast<unsigned>(sensor.width)),
                      static_cast<int>(random() % static_cast<unsigned>(sensor.height)),
                      static_cast<int>(random() % 2)});
  }
  return events;
}

TEST_CASE("the refractory period keeps a pixel's first event and those a period after a kept one") {
  EventFilter filter({.refractory_us = 100}, kSmall);
  const std::vector<PlainEvent> events{{0, 1, 1, 1},   {50, 1, 1, 0},  {50, 2, 1, 1},
                                       {99, 1, 1, 1},  {100, 1, 1, 0}, {149, 2, 1, 0},
                                       {199, 1, 1, 1}, {200, 1, 1, 1}};
  CHECK(through(filter, events) ==
        std::vector<PlainEvent>{{0, 1, 1, 1}, {50, 2, 1, 1}, {100, 1, 1, 0}, {200, 1, 1, 1}});
  CHECK(filter.left_out().refractory == 4);
  CHECK(filter.left_out().sum() == 4);
}

TEST_CASE("background activity is an event without a recent one beside it; its own pixel is none") {
  EventFilter filter({.background_activity_us = 100}, kSmall);
  const std::vector<PlainEvent> events{
      {0, 3, 3, 1},     // The first one.
      {10, 3, 3, 1},    // Its own pixel only.
      {110, 4, 4, 0},   // Across a corner, exactly 100 µs after.
      {111, 6, 4, 0},   // Two pixels away.
      {200, 5, 5, 1},   // Beside two events, the second of which was left out.
      {301, 5, 4, 1},   // One µs too late for all.
      {302, 0, 0, 1},   // In a corner of the sensor.
      {303, 7, 0, 1},   // A row's end is not beside the next row's beginning.
      {304, 0, 1, 1}};  // Below the corner.
  CHECK(through(filter, events) ==
        std::vector<PlainEvent>{{110, 4, 4, 0}, {200, 5, 5, 1}, {304, 0, 1, 1}});
  CHECK(filter.left_out().background == 6);
}

TEST_CASE("ages stay exact in a packet of 70 minutes and in a stream of hours") {
  constexpr std::int64_t kMinuteUs = 60'000'000;
  // 2^32 us later: in 32 bits the same time.
  constexpr std::int64_t kWrapUs = std::int64_t{1} << 32;
  EventFilter filter({.refractory_us = 1000}, kSmall);
  const std::vector<PlainEvent> events{{5, 1, 1, 1},
                                       {70 * kMinuteUs, 2, 1, 1},
                                       {kWrapUs + 4, 1, 1, 1},
                                       {kWrapUs + 5, 3, 1, 1},
                                       {kWrapUs + 1003, 1, 1, 1},
                                       {kWrapUs + 1004, 1, 1, 1},
                                       {4 * kWrapUs + 1004, 1, 1, 1},
                                       {4 * kWrapUs + 1005, 1, 1, 0}};
  std::vector<PlainEvent> expected = events;
  expected.erase(expected.begin() + 7);
  expected.erase(expected.begin() + 4);
  for (const std::size_t size : {std::size_t{1}, std::size_t{2}}) {
    CHECK(through(filter, events, size) == expected);
    filter.reset();
  }
  EventFilter active({.background_activity_us = 1000}, kSmall);
  const std::vector<PlainEvent> apart{{0, 1, 1, 1}, {kWrapUs, 2, 1, 1}, {kWrapUs + 1, 1, 1, 1}};
  CHECK(through(active, apart, 1) == std::vector<PlainEvent>{{kWrapUs + 1, 1, 1, 1}});
}

TEST_CASE("the longest packet fits the longest period") {
  EventPacket packet;
  Event event;
  event.x = 1;
  packet.events = {event, event, event, event};
  packet.events[1].offset_us = 9'999'999;
  packet.events[2].offset_us = 4'294'967'290;
  packet.events[3].offset_us = 4'294'967'295;
  EventFilter filter({.refractory_us = 10'000'000}, kSmall);
  filter.apply(packet);
  REQUIRE(packet.events.size() == 2);
  CHECK(packet.events[1].offset_us == 4'294'967'290);
}

TEST_CASE("times that go back before the first one are a new beginning") {
  EventFilter filter({.refractory_us = 1000}, kSmall);
  const std::vector<PlainEvent> events{{5000, 1, 1, 1}, {100, 1, 1, 1}, {200, 1, 1, 1}};
  CHECK(through(filter, events, 1).size() == 2);
}

TEST_CASE("packets of any length are filtered alike, and the counts add up") {
  const std::vector<PlainEvent> events = random_events(kSmall, 20'000);
  const EventFilterParams params{.mask = PixelMask(kSmall, std::vector<PixelPlace>{{2, 4}}),
                                 .crop = Region{1, 0, 6, 5},
                                 .polarity = EventFilterParams::Polarity::kOn,
                                 .refractory_us = 700,
                                 .background_activity_us = 60,
                                 .turn = {.flip_x = true, .rotate_deg = 90}};
  EventFilter filter(params, kSmall);
  const std::vector<PlainEvent> left = through(filter, events, 1);
  const FilteredEvents counts = filter.left_out();
  CHECK(left.size() + static_cast<std::size_t>(counts.sum()) == events.size());
  for (const std::int64_t count : {counts.masked, counts.outside_crop, counts.other_polarity,
                                   counts.refractory, counts.background}) {
    CHECK(count > 100);
  }
  CHECK(left.size() > 100);
  for (const std::size_t size : {std::size_t{7}, std::size_t{4096}}) {
    EventFilter other(params, kSmall);
    CHECK(through(other, events, size) == left);
  }
  filter.reset();
  CHECK(filter.left_out().sum() == 0);
  CHECK(through(filter, events, 100) == left);
}

TEST_CASE("filters work in their order: what an earlier one left out is no neighbour") {
  EventFilter polarity({.polarity = EventFilterParams::Polarity::kOff, .refractory_us = 100},
                       kSmall);
  // The event of the other polarity does not blind the pixel.
  CHECK(through(polarity, {{0, 1, 1, 1}, {10, 1, 1, 0}}) == std::vector<PlainEvent>{{10, 1, 1, 0}});
  EventFilter refractory({.refractory_us = 100, .background_activity_us = 50}, kSmall);
  // The second event would have been a neighbour of the third.
  CHECK(through(refractory, {{0, 1, 1, 1}, {40, 1, 1, 1}, {60, 2, 1, 1}}).empty());
  CHECK(refractory.left_out().refractory == 1);
  CHECK(refractory.left_out().background == 2);
}

TEST_CASE("a crop keeps the sensor's size, or becomes the sensor") {
  const std::vector<PlainEvent> events{{0, 1, 2, 0}, {1, 3, 4, 1}, {2, 4, 4, 1}, {3, 3, 5, 1}};
  EventFilter stays({.crop = Region{1, 2, 3, 3}}, kSmall);
  CHECK(through(stays, events) == std::vector<PlainEvent>{{0, 1, 2, 0}, {1, 3, 4, 1}});
  CHECK(stays.sensor() == kSmall);
  CHECK(stays.left_out().outside_crop == 2);
  EventFilter becomes({.crop = Region{1, 2, 3, 3}, .crop_is_sensor = true}, kSmall);
  CHECK(through(becomes, events) == std::vector<PlainEvent>{{0, 0, 0, 0}, {1, 2, 2, 1}});
  CHECK(becomes.sensor() == SensorSize{3, 3});
}

TEST_CASE("a picture is mirrored, then rotated clockwise") {
  // In a picture of 8 x 6: near the upper left corner.
  const std::vector<PlainEvent> event{{0, 1, 2, 1}};
  const auto turned = [&](const PictureTurn& turn) {
    EventFilter filter({.turn = turn}, kSmall);
    const PlainEvent to = through(filter, event).front();
    return std::array<int, 4>{to.x, to.y, filter.sensor().width, filter.sensor().height};
  };
  using Place = std::array<int, 4>;
  CHECK(turned({.flip_x = true}) == Place{6, 2, 8, 6});
  CHECK(turned({.flip_y = true}) == Place{1, 3, 8, 6});
  CHECK(turned({.rotate_deg = 90}) == Place{3, 1, 6, 8});
  CHECK(turned({.rotate_deg = 180}) == Place{6, 3, 8, 6});
  CHECK(turned({.rotate_deg = 270}) == Place{2, 6, 6, 8});
  CHECK(turned({.flip_x = true, .rotate_deg = 90}) == Place{3, 6, 6, 8});
}

TEST_CASE("four quarter turns, and two flips, change nothing") {
  constexpr SensorSize kSensor{13, 7};
  const std::vector<PlainEvent> events = random_events(kSensor, 500);
  const auto repeated = [&](const PictureTurn& turn, int times) {
    std::vector<PlainEvent> now = events;
    SensorSize sensor = kSensor;
    for (int i = 0; i < times; ++i) {
      EventFilter filter({.turn = turn}, sensor);
      now = through(filter, now, 100);
      sensor = filter.sensor();
    }
    CHECK(sensor.width * sensor.height == 13 * 7);
    return now;
  };
  CHECK(repeated({.rotate_deg = 90}, 4) == events);
  CHECK(repeated({.rotate_deg = 270}, 4) == events);
  CHECK(repeated({.rotate_deg = 180}, 2) == events);
  CHECK(repeated({.flip_x = true}, 2) == events);
  CHECK(repeated({.flip_y = true}, 2) == events);
  // A half turn is both flips.
  CHECK(repeated({.rotate_deg = 180}, 1) == repeated({.flip_x = true, .flip_y = true}, 1));
  CHECK(repeated({.rotate_deg = 90}, 1) != events);
}

TEST_CASE("an event outside the sensor, of any source, is left out and counted") {
  EventFilter filter({.refractory_us = 1, .background_activity_us = 1}, kSmall);
  CHECK(through(filter, {{0, 8, 0, 1}, {1, 0, 6, 1}, {2, 2000, 2000, 0}}).empty());
  CHECK(filter.left_out().outside_sensor == 3);
}

TEST_CASE("without settings a filter changes nothing; with a bad one it names it and the value") {
  const std::vector<PlainEvent> events = random_events(kSmall, 100);
  EventFilter none({}, kSmall);
  CHECK(through(none, events) == events);
  CHECK(EventFilterParams{}.is_off());

  const auto refusal = [](const EventFilterParams& params) {
    return message_of<std::invalid_argument>([&] { EventFilter(params, kSmall); });
  };
  CHECK(refusal({.crop = Region{4, 0, 5, 6}, .crop_name = "camera.crop"}) ==
        "camera.crop must lie within the sensor of 8 x 6 px, got [4, 0, 5, 6]");
  CHECK(contains(refusal({.crop = Region{-1, 0, 5, 6}}), "got [-1, 0, 5, 6]"));
  CHECK(contains(refusal({.crop = Region{2, 2, 0, 3}}), "got [2, 2, 0, 3]"));
  CHECK(contains(refusal({.mask = PixelMask({8, 8}, {}), .mask_name = "m.toml"}),
                 "m.toml is of a sensor of 8x8 px"));
  CHECK(refusal({.refractory_us = 10'000'001}) ==
        "the refractory period must be from 0 to 10000000 us, got 10000001");
  CHECK(contains(refusal({.background_activity_us = -1}), "got -1"));
}

}  // namespace
}  // namespace puck
