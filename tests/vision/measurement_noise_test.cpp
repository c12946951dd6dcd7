#include "common/vision/paper/measurement_noise.h"

#include <cmath>

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("a peak with bright pixels all round has their variance over their number") {
  // A contour of 50 bright pixels has half of their weight in each direction.
  const PixelVariance variance = measurement_variance({{}, 24.9, 0, 24.9}, {0.1, 0.5});
  CHECK(variance.x == doctest::Approx(0.01 + 0.5 / 25));
  CHECK(variance.y == variance.x);
}

TEST_CASE("a peak is less certain along an edge than across it") {
  const PixelVariance variance = measurement_variance({{}, 2, 0, 20}, {0, 1});
  CHECK(variance.x > 5 * variance.y);
}

TEST_CASE("a slanting edge fixes neither axis alone") {
  // A weight of 20 pixels across the diagonal, hardly any along it.
  const PixelVariance variance = measurement_variance({{}, 10, 9.9, 10}, {0, 1});
  CHECK(variance.x > 1);
  CHECK(variance.y > 1);
}

TEST_CASE("without bright pixels the variance is large, not infinite") {
  const PixelVariance variance = measurement_variance({}, {0, 1});
  CHECK(variance.x == doctest::Approx(10));
  CHECK(std::isfinite(variance.y));
}

}  // namespace puck
