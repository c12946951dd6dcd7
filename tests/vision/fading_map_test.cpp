#include "common/vision/scene/fading_map.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/vision/random_numbers.h"

namespace puck {
namespace {

constexpr SensorSize kMapSensor{64, 48};

TEST_CASE("An event counts 1 at its place, a half beside it and a quarter diagonally") {
  FadingMap map(kMapSensor);
  for (int i = 0; i < 4; ++i) map.add({20.3, 9.8});
  CHECK(map.level({20, 10}) == doctest::Approx(4));
  CHECK(map.level({21, 10}) == doctest::Approx(2));
  CHECK(map.level({20, 9}) == doctest::Approx(2));
  CHECK(map.level({19, 11}) == doctest::Approx(1));
  CHECK(map.level({22, 10}) == 0);
}

TEST_CASE("Between pixels the map is linear, with its gradient") {
  FadingMap map(kMapSensor);
  for (int i = 0; i < 4; ++i) map.add({20, 10});
  const FadingMap::Sample sample = map.sample({20.25, 10});
  CHECK(sample.level == doctest::Approx(3.5));
  CHECK(sample.slope_x == doctest::Approx(-2));
  CHECK(sample.slope_y == doctest::Approx(-1.75));
}

TEST_CASE("Uniform noise exceeds its stated level hardly anywhere, and half of it in many places") {
  constexpr int kEventsAMs = 12;  // of 64 × 48 pixels
  FadingMap map(kMapSensor);
  CHECK(map.level_of_noise() == 0);
  test::RandomNumbers random;
  for (int i = 1; i <= 6'000; ++i) {
    map.advance(i * 1'000);
    map.note_noise(kEventsAMs / (64.0 * 48));
    for (int n = 0; n < kEventsAMs; ++n) {
      const double x = random.below(64);
      map.add({x, static_cast<double>(random.below(48))});
    }
  }
  const double level = map.level_of_noise();
  int above = 0;
  int above_half = 0;
  for (int y = 2; y < 46; ++y) {
    for (int x = 2; x < 62; ++x) {
      above += map.level(Pixel{1.0 * x, 1.0 * y}) > level;
      above_half += map.level(Pixel{1.0 * x, 1.0 * y}) > level / 2;
    }
  }
  CHECK(above <= 3);  // of 2,640
  CHECK(above_half > 1'300);
  map.clear();
  CHECK(map.level_of_noise() == 0);
}

TEST_CASE("The map decays with 1.5 s, for any time") {
  FadingMap map(kMapSensor);
  for (int i = 0; i < 4; ++i) map.add({20, 10});
  map.advance(1'500'000);
  CHECK(map.level({20, 10}) == doctest::Approx(4 / std::exp(1.0)));
  for (int i = 2; i <= 40; ++i) map.advance(i * 1'500'000LL);
  CHECK(map.level({20, 10}) < 1e-6);
  for (int i = 0; i < 4; ++i) map.add({20, 10});
  CHECK(map.level({20, 10}) == doctest::Approx(4));
}

TEST_CASE("The map reaches a quarter beyond the image, and no farther") {
  FadingMap map(kMapSensor);
  map.add({-13, 50});
  CHECK(map.level({-13, 50}) > 0);
  map.add({-40, 20});
  map.add({20, 1e4});
  CHECK(map.level({-40, 20}) == 0);
  CHECK(map.sample({-40, 20}).level == 0);
}

TEST_CASE("A cleared map is zero everywhere") {
  FadingMap map(kMapSensor);
  for (int i = 0; i < 4; ++i) map.add({20, 10});
  map.clear();
  CHECK(map.level({20, 10}) == 0);
}

}  // namespace
}  // namespace puck
