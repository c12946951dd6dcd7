#include "tools/play/frame_tracker.h"

#include <cmath>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/play_tool/play_bench.h"

namespace puck {
namespace {

TEST_CASE("A camera gives the puck's place in the middle of each exposure") {
  FrameTrackerParams params{.rate_hz = 50, .sigma_px = 0, .smear_share = 0};
  FrameTracker tracker(params, kSensor, 1);
  SimulatedTruth truth;
  truth.in_play = true;
  int pictures = 0;
  for (std::int64_t us = 0; us < 200'000; us += kStepUs) {
    truth.time = {us};
    truth.position_px = {100 + 1e-3 * static_cast<double>(us), 200};
    const auto estimate = tracker.watch(truth);
    if (!estimate) continue;
    REQUIRE(estimate->position);
    CHECK(estimate->newest_event.us == 20'000 * pictures + 5'000);
    CHECK(estimate->position->x ==
          doctest::Approx(100 + 1e-3 * static_cast<double>(estimate->newest_event.us)));
    CHECK(estimate->velocity.x == doctest::Approx(1000).epsilon(0.01));
    CHECK(us - estimate->newest_event.us == doctest::Approx(5'000).epsilon(0.05));
    ++pictures;
  }
  CHECK(pictures == 10);
  CHECK(tracker.delay_us() == 23'000);
}

TEST_CASE("Motion blur makes an image less sharp") {
  FrameTrackerParams params{.rate_hz = 500, .sigma_px = 0.3, .smear_share = 0.1};
  FrameTracker tracker(params, kSensor, 1);
  SimulatedTruth truth;
  truth.in_play = true;
  double square = 0;
  int pictures = 0;
  for (std::int64_t us = 0; us < 2'000'000; us += kStepUs) {
    truth.time = {us};
    // 4 px in an exposure of 1 ms.
    const double phase_px = std::fmod(4e-3 * static_cast<double>(us), 400);
    truth.position_px = {100 + phase_px, 200};
    const auto estimate = tracker.watch(truth);
    if (!estimate || phase_px < 20) continue;
    const double error = estimate->position->y - 200;
    square += error * error;
    ++pictures;
  }
  CHECK(std::sqrt(square / pictures) == doctest::Approx(std::hypot(0.3, 0.4)).epsilon(0.1));
}

TEST_CASE("A puck that leaves the image during an exposure is not tracked") {
  FrameTracker tracker({.rate_hz = 50}, kSensor, 1);
  SimulatedTruth truth;
  truth.in_play = true;
  for (std::int64_t us = 0; us < 20'000; us += kStepUs) {
    truth.time = {us};
    truth.position_px = {600 + 1e-2 * static_cast<double>(us), 200};
    if (const auto estimate = tracker.watch(truth)) {
      CHECK(estimate->state == TrackState::kLost);
      CHECK_FALSE(estimate->position);
      return;
    }
  }
  FAIL("no picture");
}

TEST_CASE("A camera refuses an impossible rate or exposure") {
  CHECK_THROWS_AS(FrameTracker({.rate_hz = 0}, kSensor, 1), std::invalid_argument);
  CHECK_THROWS_AS(FrameTracker({.exposure_share = 1.1}, kSensor, 1), std::invalid_argument);
}

}  // namespace
}  // namespace puck
