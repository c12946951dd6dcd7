#include "common/vision/turn_trail.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "tests/vision/turned_camera.h"

namespace puck {
namespace {

using test::kFocal_px;
using test::kMiddle;

TEST_CASE("The image of what stands still moves against the steps, at each place by its slopes") {
  CameraTurn turn(kMiddle, kFocal_px);
  TurnTrail trail;
  for (int i = 1; i <= 20; ++i) {
    CHECK(trail.still_velocity_at(kMiddle).has_value() == (i > 12));
    turn.turn({0.2, -0.1, 0.4});
    trail.note(turn, 1'000 * i);
  }
  for (const Pixel place : {kMiddle, Pixel{30, 450}, Pixel{600, 60}}) {
    const CameraTurn::Slopes slopes = turn.slopes_at(place);
    const PixelVelocity velocity = trail.still_velocity_at(place).value();
    const auto along = [](const CameraTurn::Steps& slope) {
      return -1'000 * (0.2 * slope[0] - 0.1 * slope[1] + 0.4 * slope[2]);
    };
    CHECK(velocity.x == doctest::Approx(along(slopes.x)).epsilon(0.03));
    CHECK(velocity.y == doctest::Approx(along(slopes.y)).epsilon(0.03));
  }
}

TEST_CASE("However far apart the notes are, the velocity is a second's") {
  CameraTurn turn(kMiddle, kFocal_px);
  TurnTrail trail;
  for (int i = 1; i <= 12; ++i) {
    turn.turn({0.7, 0, 0});
    trail.note(turn, 1'400 * i);
  }
  CHECK(trail.still_velocity_at(kMiddle).value().x == doctest::Approx(-500).epsilon(0.01));
}

TEST_CASE("Of a shaking head the velocity is that of the last milliseconds") {
  TurnTrail trail;
  const auto shaken_px = [](int i) { return 2 * std::sin(2 * std::numbers::pi * 10 * i * 1e-3); };
  CameraTurn turn(kMiddle, kFocal_px);
  double worst_px_s = 0;
  for (int i = 1; i <= 300; ++i) {
    turn.turn({shaken_px(i) - shaken_px(i - 1), 0, 0});
    trail.note(turn, 1'000 * i);
    if (i < 20) continue;
    const double truth_px_s = -1'000 * (shaken_px(i) - shaken_px(i - 1));
    worst_px_s =
        std::max(worst_px_s, std::abs(trail.still_velocity_at(kMiddle).value().x - truth_px_s));
  }
  // Of up to 126 px/s.
  CHECK(worst_px_s < 50);
}

TEST_CASE("What came before a clearing is forgotten") {
  CameraTurn turn(kMiddle, kFocal_px);
  TurnTrail trail;
  for (int i = 1; i <= 12; ++i) trail.note(turn, 1'000 * i);
  REQUIRE(trail.still_velocity_at(kMiddle));
  trail.clear();
  CHECK_FALSE(trail.still_velocity_at(kMiddle));
}

}  // namespace
}  // namespace puck
