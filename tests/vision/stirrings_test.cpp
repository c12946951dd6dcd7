#include "common/vision/stirrings.h"

#include <random>

#include <doctest/doctest.h>

namespace puck {
namespace {

// Half a second of noise of so many events a millisecond; how often it stirred.
int stirs_in_noise(Stirrings& stirrings, int events_per_ms, unsigned seed) {
  std::mt19937 random(seed);
  int stirs = 0;
  for (std::int64_t time_us = 1'000'000; time_us < 1'500'000; time_us += 1'000) {
    for (int i = 0; i < events_per_ms; ++i) {
      stirrings.take(static_cast<int>(random() % 640), static_cast<int>(random() % 480));
    }
    stirrings.judge(time_us);
    stirs += stirrings.is_still(time_us) ? 0 : 1;
  }
  return stirs;
}

TEST_CASE("uniform noise never stirs, however much of it there is") {
  for (const unsigned seed : {1u, 2u, 3u}) {
    for (const int events_per_ms : {1, 10, 100, 1000}) {
      CAPTURE(seed);
      CAPTURE(events_per_ms);
      Stirrings stirrings({640, 480});
      CHECK(stirs_in_noise(stirrings, events_per_ms, seed) == 0);
    }
  }
}

TEST_CASE("a few events in one place stir, for a tenth of a second") {
  Stirrings stirrings({640, 480});
  CHECK(stirrings.is_still(0));
  for (int i = 0; i < 10; ++i) stirrings.take(639, 470 + i);
  stirrings.judge(5'000);
  CHECK_FALSE(stirrings.is_still(5'000));
  stirrings.judge(105'000);
  CHECK_FALSE(stirrings.is_still(105'000));
  CHECK(stirrings.is_still(105'001));
}

TEST_CASE("events that are too far apart in time do not stir") {
  Stirrings stirrings({640, 480});
  for (int i = 0; i < 100; ++i) {
    stirrings.take(300, 200);
    stirrings.judge(i * 20'000);
    CHECK(stirrings.is_still(i * 20'000));
  }
}

}  // namespace
}  // namespace puck
