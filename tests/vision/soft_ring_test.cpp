#include "common/vision/contour/soft_ring.h"

#include <cmath>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/vision/ring_picture.h"
#include "tests/vision/test_sensor.h"

namespace puck {
namespace {

using test::kSensor;

// The horizon lies at row −200; a puck is 34 px wide and 21 px high in row 140.
constexpr PuckSizeModel kTablePlane{20, 0, 0.1, 7, 0, 0.1};
constexpr PuckSizeModel kModelOfRow140{34, 0, 0, 21, 0, 0};
constexpr ContourCalibration kAsAnnotated{0, 0, 0};

SoftRing ring_with(const PuckSizeModel& model) { return {kSensor, {}, model, kAsAnnotated}; }

double error_px(const SoftRing::Fit& fit, Pixel truth) {
  return std::hypot(fit.position.x - truth.x, fit.position.y - truth.y);
}

}  // namespace

TEST_CASE("a ring is fitted where its picture lies in the image") {
  const Pixel truth{319.8, 140.3};
  const auto picture = test::draw_ring(80, 60, {{truth.x - 280, truth.y - 110}, 17, 10.5, 0});
  const SoftRing::Fit fit =
      ring_with(kModelOfRow140).fit(picture.view(), {280, 110, 80, 60}, {319, 141});
  CHECK(error_px(fit, truth) < 0.05);
  CHECK(fit.score > 0.8);
}

TEST_CASE("the shear of a puck beside the middle is known from the plane") {
  // 200 px right of the middle, 340 px below the horizon.
  const Pixel truth{519.5, 140};
  const double shear = 200.0 / 340;
  const double semi_y = 10.5 * 0.8;  // What a side wall leaves of it does not matter here.
  const double semi_x = std::sqrt(17 * 17 - shear * shear * semi_y * semi_y);
  const auto picture =
      test::draw_ring(100, 60, {{truth.x - 470, truth.y - 110}, semi_x, semi_y, shear});
  const Region place{470, 110, 100, 60};
  const double sheared = ring_with(kTablePlane).fit(picture.view(), place, {519, 140}).score;
  const double upright = ring_with(kModelOfRow140).fit(picture.view(), place, {519, 140}).score;
  CHECK(sheared > upright + 0.05);
}

TEST_CASE("parameters that cannot be are refused with their key") {
  PeakRefinementParams params;
  params.half_width_px = 0;
  CHECK_THROWS_WITH_AS(SoftRing(kSensor, params, kModelOfRow140, kAsAnnotated),
                       doctest::Contains("half_width_px"), std::invalid_argument);
  params = {};
  params.iterations = 0;
  CHECK_THROWS_WITH_AS(SoftRing(kSensor, params, kModelOfRow140, kAsAnnotated),
                       doctest::Contains("iterations"), std::invalid_argument);
}

}  // namespace puck
