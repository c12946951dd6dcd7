#include "common/vision/surface/event_history.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr SensorSize kTinySensor{64, 48};
constexpr Event kOn{.x = 20, .y = 10, .polarity = 1};

TEST_CASE("An event is the first of its pixel and sign for 3 ms") {
  EventHistory history(kTinySensor);
  CHECK(history.is_first(kOn, 10'000));
  CHECK_FALSE(history.is_first(kOn, 12'000));
  CHECK_FALSE(history.is_first(kOn, 15'000));
  CHECK(history.is_first(kOn, 18'001));
  CHECK(history.is_first({.x = 20, .y = 10, .polarity = 0}, 18'001));
  CHECK(history.is_first({.x = 21, .y = 10, .polarity = 1}, 18'001));
  CHECK(history.is_first({.x = 63, .y = 47, .polarity = 1}, 18'001));
}

TEST_CASE("What is late is not the first") {
  EventHistory history(kTinySensor);
  CHECK(history.is_first(kOn, 10'000));
  CHECK_FALSE(history.is_first(kOn, 9'000));
  CHECK(history.is_first(kOn, 12'001));
}

TEST_CASE("First events are told in a run of hours, and by clocks that count from elsewhere") {
  for (const std::int64_t start_us :
       {-5'000'000LL, 0LL, (1LL << 31) - 500'000, (1LL << 32) - 4'000, 1'700'000'000'000'000LL}) {
    EventHistory history(kTinySensor);
    CHECK(history.is_first(kOn, start_us));
    CHECK_FALSE(history.is_first(kOn, start_us + 3'000));
    CHECK(history.is_first(kOn, start_us + 6'001));
    constexpr std::int64_t kHour_us = 3'600'000'000;
    CHECK(history.is_first(kOn, start_us + kHour_us));
    CHECK(history.is_first(kOn, start_us + 2 * kHour_us));
  }
}

}  // namespace
}  // namespace puck
