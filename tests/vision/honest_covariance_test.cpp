#include "common/vision/honest_covariance.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

const ContourFilter kFilter({}, {.velocity = {1000, 500}, .sigma_px = 2, .sigma_px_s = 100}, 0);

TEST_CASE("What the lag leaves grows with the speed, and pixels leave a floor") {
  const std::array<double, 16> covariance = honest_covariance(kFilter, {});
  CHECK(covariance[0] == doctest::Approx(4 + 0.08 * 0.08 + 0.04 * 0.04));
  CHECK(covariance[1] == doctest::Approx(0.08 * 0.04));
  CHECK(covariance[4] == covariance[1]);
  CHECK(covariance[5] == doctest::Approx(4 + 0.04 * 0.04 + 0.04 * 0.04));
  CHECK(covariance[10] == doctest::Approx(10'000));
}

TEST_CASE("Where a pixel makes five events of a passing, the filter's variance is a fifth") {
  PuckSignature signature;
  signature.learn({.quick_events = 500, .first_events = 100}, 0);
  const std::array<double, 16> covariance = honest_covariance(kFilter, signature);
  CHECK(covariance[0] == doctest::Approx(0.8 + 0.08 * 0.08 + 0.04 * 0.04));
  CHECK(covariance[10] == doctest::Approx(2'000));
}

}  // namespace
}  // namespace puck
