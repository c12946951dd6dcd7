#include "common/vision/fading_map.h"

#include <cmath>

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr SensorSize kSensor{64, 48};

TEST_CASE("An event counts at its place, half beside it and a quarter across") {
  FadingMap map(kSensor);
  for (int i = 0; i < 4; ++i) map.add({20.3, 9.8});
  CHECK(map.level({20, 10}) == doctest::Approx(4));
  CHECK(map.level({21, 10}) == doctest::Approx(2));
  CHECK(map.level({20, 9}) == doctest::Approx(2));
  CHECK(map.level({19, 11}) == doctest::Approx(1));
  CHECK(map.level({22, 10}) == 0);
}

TEST_CASE("Between pixels the map is linear, and says how steep it is") {
  FadingMap map(kSensor);
  for (int i = 0; i < 4; ++i) map.add({20, 10});
  const FadingMap::Sample sample = map.sample({20.25, 10});
  CHECK(sample.level == doctest::Approx(3.5));
  CHECK(sample.slope_x == doctest::Approx(-2));
  CHECK(sample.slope_y == doctest::Approx(-1.75));
}

TEST_CASE("The map fades with 1.5 s, for as long as it is kept") {
  FadingMap map(kSensor);
  for (int i = 0; i < 4; ++i) map.add({20, 10});
  map.advance(1'500'000);
  CHECK(map.level({20, 10}) == doctest::Approx(4 / std::exp(1.0)));
  for (int i = 2; i <= 40; ++i) map.advance(i * 1'500'000LL);
  CHECK(map.level({20, 10}) < 1e-6);
  for (int i = 0; i < 4; ++i) map.add({20, 10});
  CHECK(map.level({20, 10}) == doctest::Approx(4));
}

TEST_CASE("The map reaches a quarter beyond the image, and no farther") {
  FadingMap map(kSensor);
  map.add({-13, 50});
  CHECK(map.level({-13, 50}) > 0);
  map.add({-40, 20});
  map.add({20, 1e4});
  CHECK(map.level({-40, 20}) == 0);
  CHECK(map.sample({-40, 20}).level == 0);
}

TEST_CASE("A map that is cleared shows nothing") {
  FadingMap map(kSensor);
  for (int i = 0; i < 4; ++i) map.add({20, 10});
  map.clear();
  CHECK(map.level({20, 10}) == 0);
}

}  // namespace
}  // namespace puck
