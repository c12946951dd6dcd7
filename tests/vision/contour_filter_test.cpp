#include "common/vision/contour/contour_filter.h"

#include <cmath>

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr double kDamping_s = 1;

ContourFilter at_origin() { return {{}, {.velocity = {100, -50}}, 0}; }

TEST_CASE("Prediction moves with the velocity, and the uncertainty grows with the time") {
  ContourFilter filter = at_origin();
  const double before = filter.distance_variance(1, 0);
  filter.predict(10'000, kDamping_s);
  CHECK(filter.position().x == doctest::Approx(1));
  CHECK(filter.position().y == doctest::Approx(-0.5));
  // Damped with a time constant of a second.
  CHECK(filter.velocity().x == doctest::Approx(99));
  CHECK(filter.distance_variance(1, 0) > before + 900 * 900 * 1e-4);
}

TEST_CASE("An earlier position follows from the velocity; a later one is the present position") {
  const ContourFilter filter({}, {.position = {100, 50}, .velocity = {1000, -500}}, 20'000);
  CHECK(filter.position_at(10'000) == Pixel{90, 55});
  CHECK(filter.position_at(30'000) == Pixel{100, 50});
}

TEST_CASE("A filter with a short time constant comes to rest") {
  ContourFilter filter = at_origin();
  for (int i = 1; i <= 300; ++i) filter.predict(i * 1000, 0.06);
  CHECK(filter.speed_px_s() < 1);
}

TEST_CASE("An event moves the contour along its normal only, and reduces the variance there") {
  // Of a known size.
  ContourFilter filter({}, {.growth_variance_px2 = 0}, 0);
  const double along = filter.distance_variance(1, 0);
  const double across = filter.distance_variance(0, 1);
  filter.correct(1, 1, 0);
  CHECK(filter.position().x > 0.3);
  CHECK(filter.position().y == 0);
  CHECK(filter.distance_variance(1, 0) < along);
  CHECK(filter.distance_variance(0, 1) == across);
}

// Gives a filter events all round of a contour that is 3 px larger.
void enlarge(ContourFilter& filter) {
  for (int i = 1; i <= 400; ++i) {
    filter.predict(i * 100, kDamping_s);
    filter.correct(3 - filter.position().x - filter.growth_px(), 1, 0);
    filter.correct(3 + filter.position().x - filter.growth_px(), -1, 0);
  }
}

TEST_CASE("Slack raises the bound on the contour's size, while it lasts") {
  ContourFilter filter = at_origin();
  enlarge(filter);
  CHECK(filter.growth_px() == doctest::Approx(0.8));
  filter = at_origin();
  filter.give_slack(1);
  enlarge(filter);
  CHECK(filter.growth_px() == doctest::Approx(1.8));
  filter.give_slack(0.5);
  CHECK(filter.growth_px() == doctest::Approx(1.3));
}

TEST_CASE("Events outside on both sides make the puck larger, without moving it") {
  ContourFilter filter = at_origin();
  for (int i = 0; i < 50; ++i) {
    filter.correct(0.5 - filter.position().x - filter.growth_px(), 1, 0);
    filter.correct(0.5 + filter.position().x - filter.growth_px(), -1, 0);
  }
  // Less than half a pixel, since sizes are expected to be as calibrated.
  CHECK(filter.growth_px() > 0.3);
  CHECK(filter.growth_px() < 0.5);
  CHECK(std::abs(filter.position().x) < 0.1);
}

TEST_CASE("Growth and speed stay within their bounds") {
  ContourFilter filter = at_origin();
  for (int i = 1; i <= 200; ++i) {
    filter.predict(i * 100, kDamping_s);
    filter.correct(5, 1, 0);
    filter.correct(5, -1, 0);
  }
  CHECK(filter.growth_px() <= 0.8);
  for (int i = 201; i <= 1000; ++i) {
    filter.predict(i * 100, kDamping_s);
    filter.correct(5, 1, 0);
  }
  CHECK(filter.speed_px_s() <= 12'000 * 1.0001);
}

}  // namespace
}  // namespace puck
