#include "common/vision/surface/fresh_pixels.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <doctest/doctest.h>

namespace puck {
namespace {

// A width that is no multiple of eight.
constexpr SensorSize kOddSensor{37, 21};
constexpr Region kWholeSensor{0, 0, 37, 21};

Event event_after(int x, int y, std::int64_t offset_us = 0) {
  Event event;
  event.x = static_cast<std::uint16_t>(x);
  event.y = static_cast<std::uint16_t>(y) & 0x7fffu;
  event.offset_us = static_cast<std::uint32_t>(offset_us);
  return event;
}

// The pixels of `part` that are fresh, of a picture that is bright everywhere.
Image<std::uint8_t> fresh_of(const FreshPixels& pixels, const Region& part) {
  Image<std::uint8_t> grey;
  grey.resize(part.width, part.height);
  std::fill_n(grey.row(0), static_cast<std::size_t>(part.width * part.height), std::uint8_t{200});
  FreshRows rows;
  pixels.copy_rows(part, rows);
  rows.darken_stale(part, grey.mutable_view());
  return grey;
}

bool is_fresh(const FreshPixels& pixels, int x, int y) {
  return fresh_of(pixels, {x, y, 1, 1})(0, 0) == 200;
}

TEST_CASE("A pixel is fresh for 24 to 32 ms, whether there are events elsewhere or not") {
  for (const bool others : {false, true}) {
    CAPTURE(others);
    FreshPixels pixels(kOddSensor);
    pixels.take({1'007'000}, std::vector{event_after(5, 6)});
    if (others) {
      for (int ms = 1'008; ms <= 1'031; ++ms) {
        pixels.take({ms * 1'000}, std::vector{event_after(30, 20)});
      }
    }
    pixels.take({1'031'999}, std::vector{event_after(30, 20)});
    CHECK(is_fresh(pixels, 5, 6));
    pixels.take({1'032'000}, std::vector{event_after(30, 20)});
    CHECK_FALSE(is_fresh(pixels, 5, 6));
    CHECK(is_fresh(pixels, 30, 20));
  }
}

TEST_CASE("After a long silence only what has come since is fresh") {
  FreshPixels pixels(kOddSensor);
  pixels.take({0}, std::vector{event_after(1, 1), event_after(2, 2, 7'000'000)});
  CHECK_FALSE(is_fresh(pixels, 1, 1));
  CHECK(is_fresh(pixels, 2, 2));
}

TEST_CASE("Exactly the pixels that have fired are left, in any part of the sensor") {
  std::mt19937 random(1);
  std::vector<Event> events;
  std::vector<bool> fired(37 * 21);
  for (int i = 0; i < 300; ++i) {
    const int x = static_cast<int>(random() % 37);
    const int y = static_cast<int>(random() % 21);
    events.push_back(event_after(x, y, i));
    fired[static_cast<std::size_t>(y * 37 + x)] = true;
  }
  FreshPixels pixels(kOddSensor);
  pixels.take({0}, events);
  for (const Region& part : {kWholeSensor, Region{3, 2, 17, 5}, Region{36, 0, 1, 21},
                             Region{8, 8, 16, 8}, Region{7, 20, 9, 1}, Region{29, 4, 8, 3}}) {
    CAPTURE(part.x);
    const Image<std::uint8_t> grey = fresh_of(pixels, part);
    for (int y = 0; y < part.height; ++y) {
      for (int x = 0; x < part.width; ++x) {
        const auto place = static_cast<std::size_t>((part.y + y) * 37 + part.x + x);
        REQUIRE(grey(x, y) == (fired[place] ? 200 : 0));
      }
    }
  }
}

TEST_CASE("In parts or at once, what is fresh is the same") {
  std::vector<Event> events;
  for (int i = 0; i < 200; ++i) events.push_back(event_after(i % 37, i * 7 % 21, i * 499));
  FreshPixels at_once(kOddSensor);
  FreshPixels in_parts(kOddSensor);
  at_once.take({123'456}, events);
  for (const Event& event : events) in_parts.take({123'456}, std::span(&event, 1));
  const Image<std::uint8_t> a = fresh_of(at_once, kWholeSensor);
  const Image<std::uint8_t> b = fresh_of(in_parts, kWholeSensor);
  CHECK(std::equal(a.row(0), a.row(0) + 37 * 21, b.row(0)));
}

}  // namespace
}  // namespace puck
