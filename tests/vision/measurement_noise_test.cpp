#include "common/vision/measurement_noise.h"

#include <cmath>

#include <doctest/doctest.h>

namespace puck {

TEST_CASE("a peak held equally everywhere has the variance of its pixels over their number") {
  // A contour of 50 bright pixels holds half as many in each direction.
  const PixelVariance variance = measurement_variance({{}, 24.9, 0, 24.9}, {0.1, 0.5});
  CHECK(variance.x == doctest::Approx(0.01 + 0.5 / 25));
  CHECK(variance.y == variance.x);
}

TEST_CASE("a peak is less certain along what holds it than across") {
  const PixelVariance variance = measurement_variance({{}, 2, 0, 20}, {0, 1});
  CHECK(variance.x > 5 * variance.y);
}

TEST_CASE("a slanting edge holds neither axis alone") {
  // As strong as 20 pixels across the diagonal, hardly along it.
  const PixelVariance variance = measurement_variance({{}, 10, 9.9, 10}, {0, 1});
  CHECK(variance.x > 1);
  CHECK(variance.y > 1);
}

TEST_CASE("nothing that holds the peak is a large variance, not an infinite one") {
  const PixelVariance variance = measurement_variance({}, {0, 1});
  CHECK(variance.x == doctest::Approx(10));
  CHECK(std::isfinite(variance.y));
}

}  // namespace puck
