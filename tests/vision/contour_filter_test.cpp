#include "common/vision/contour_filter.h"

#include <cmath>

#include <doctest/doctest.h>

namespace puck {
namespace {

ContourFilter at_origin(const ContourFilterParams& params = {}) {
  ContourFilter::Start start;
  start.velocity = {100, -50};
  return {params, start, 0};
}

TEST_CASE("Prediction moves with the velocity, and the uncertainty grows with the time") {
  ContourFilter filter = at_origin();
  const double before = filter.distance_variance(1, 0);
  filter.predict(10'000, false);
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

TEST_CASE("A blind filter comes to rest") {
  ContourFilter filter = at_origin();
  for (int i = 1; i <= 300; ++i) filter.predict(i * 1000, true);
  CHECK(filter.speed_px_s() < 1);
}

TEST_CASE("An event moves the contour along its normal only, and reduces the variance there") {
  ContourFilterParams params;
  params.follows_size = false;
  ContourFilter filter = at_origin(params);
  const double along = filter.distance_variance(1, 0);
  const double across = filter.distance_variance(0, 1);
  filter.correct(1, 1, 0);
  CHECK(filter.position().x > 0.3);
  CHECK(filter.position().y == 0);
  CHECK(filter.distance_variance(1, 0) < along);
  CHECK(filter.distance_variance(0, 1) == across);
}

TEST_CASE("A sighting moves the filter to its position, by its certainty") {
  ContourFilter filter = at_origin();
  filter.correct_place(3, -2, 2.5);
  // As certain as the filter's position.
  CHECK(filter.position().x == doctest::Approx(1.5));
  CHECK(filter.position().y == doctest::Approx(-1));
  filter.correct_place(3, -2, 0.01);
  CHECK(filter.position().x == doctest::Approx(4.5).epsilon(0.01));
  CHECK(filter.position().y == doctest::Approx(-3).epsilon(0.01));
  CHECK(filter.distance_variance(1, 0) < 0.2);
}

TEST_CASE("A sighting after a while corrects the speed, too, within the speed limit") {
  ContourFilter filter = at_origin();
  filter.predict(20'000, false);
  filter.correct_place(10, 0, 1.5);
  CHECK(filter.velocity().x > 300);
  CHECK(filter.velocity().y == doctest::Approx(-50).epsilon(0.05));
  filter.correct_place(1e6, 0, 1e-3);
  CHECK(filter.speed_px_s() == doctest::Approx(12'000));
}

// Gives a filter events all round of a contour that is 3 px larger.
void enlarge(ContourFilter& filter) {
  for (int i = 1; i <= 400; ++i) {
    filter.predict(i * 100, false);
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

TEST_CASE("A motion along two parallel edges is less certain than one across them") {
  const auto seen_by_level_edges = [](PixelVelocity velocity) {
    ContourFilter filter({}, {.position = {0, 0}, .velocity = velocity}, 0);
    for (int i = 1; i <= 200; ++i) {
      filter.predict(i * 100, false);
      filter.correct(0, 0, 1);
      filter.correct(0, 0, -1);
    }
    return filter.slide();
  };
  CHECK(seen_by_level_edges({400, 0}) > 3);
  CHECK(seen_by_level_edges({0, 400}) < 1 / 3.0);
  CHECK(at_origin().slide() == doctest::Approx(1));
  CHECK(ContourFilter({}, {.position = {0, 0}}, 0).slide() == 1);
}

TEST_CASE("Growth and speed stay within their bounds") {
  ContourFilter filter = at_origin();
  for (int i = 1; i <= 200; ++i) {
    filter.predict(i * 100, false);
    filter.correct(5, 1, 0);
    filter.correct(5, -1, 0);
  }
  CHECK(filter.growth_px() <= 0.8);
  for (int i = 201; i <= 1000; ++i) {
    filter.predict(i * 100, false);
    filter.correct(5, 1, 0);
  }
  CHECK(filter.speed_px_s() <= 12'000 * 1.0001);
}

}  // namespace
}  // namespace puck
