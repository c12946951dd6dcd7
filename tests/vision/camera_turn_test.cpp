#include "common/vision/scene/camera_turn.h"

#include <doctest/doctest.h>

#include "tests/vision/turned_camera.h"

namespace puck {
namespace {

using test::kFocal_px;
using test::kMiddle;

TEST_CASE("A camera that has not turned shows each pixel where it was") {
  const CameraTurn turn(kMiddle, kFocal_px);
  CHECK(distance_px(turn.then_of({17, 400}), {17, 400}) < 1e-9);
}

TEST_CASE("Small turns move the middle by their px, and the border by more") {
  CameraTurn turn(kMiddle, kFocal_px);
  turn.turn({2, -3, 0});
  CHECK(distance_px(turn.then_of(kMiddle), {322, 237}) < 0.02);
  CameraTurn sideways(kMiddle, kFocal_px);
  sideways.turn({2, 0, 0});
  CHECK(sideways.then_of({20, 240}).x ==
        doctest::Approx(20 + 2 * (1 + 300.0 * 300 / 490000)).epsilon(1e-3));
  CameraTurn roll(kMiddle, kFocal_px);
  roll.turn({0, 0, 7});
  CHECK(distance_px(roll.then_of({420, 240}), {420, 241}) < 0.02);
}

TEST_CASE("Turns add up to the angle of all, however many") {
  CameraTurn turn(kMiddle, kFocal_px);
  for (int i = 0; i < 1000; ++i) turn.turn({0.1, 0, 0});
  CHECK(turn.then_of(kMiddle).x == doctest::Approx(320 + 700 * std::tan(100 / 700.0)));
  for (int i = 0; i < 1000; ++i) turn.turn({-0.1, 0, 0});
  CHECK(distance_px(turn.then_of({17, 400}), {17, 400}) < 1e-6);
}

TEST_CASE("now_of undoes then_of") {
  CameraTurn turn(kMiddle, kFocal_px);
  turn.turn({40, -25, 60});
  turn.turn({-3, 80, 5});
  for (const Pixel place : {Pixel{17, 400}, Pixel{600, 30}, kMiddle}) {
    REQUIRE(distance_px(turn.then_of(place), place) > 20);
    CHECK(distance_px(turn.now_of(turn.then_of(place)), place) < 1e-9);
  }
}

TEST_CASE("The slopes are by how much a step moves a pixel") {
  for (std::size_t k = 0; k < 3; ++k) {
    const Pixel place{120, 410};
    CameraTurn turn(kMiddle, kFocal_px);
    CameraTurn::Steps step{};
    step[k] = 0.01;
    turn.turn(step);
    const CameraTurn::Slopes slopes = turn.slopes_at(place);
    CHECK((turn.then_of(place).x - place.x) / 0.01 == doctest::Approx(slopes.x[k]).epsilon(0.01));
    CHECK((turn.then_of(place).y - place.y) / 0.01 == doctest::Approx(slopes.y[k]).epsilon(0.01));
  }
}

}  // namespace
}  // namespace puck
