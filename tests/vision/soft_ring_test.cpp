#include "common/vision/contour/soft_ring.h"

#include <algorithm>
#include <cmath>

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
constexpr Region kAtOrigin{0, 0, 100, 90};

SoftRing ring_with(const PuckSizeModel& model) { return {kSensor, model, kAsAnnotated}; }

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

TEST_CASE("a ring is found to a seventh of the way, to a twentieth of a pixel when near") {
  for (const double semi : {8.0, 15.0, 28.0}) {
    for (const Pixel off : {Pixel{0, 0}, {0.3, -0.25}, {-0.7, 0.6}, {1.2, 0.4}}) {
      CAPTURE(semi);
      CAPTURE(off.x);
      const Pixel centre{50 + off.x, 45 + off.y};
      const auto picture = test::draw_ring(100, 90, {centre, semi, 0.65 * semi, 0});
      const PuckSizeModel size{2 * semi, 0, 0, 1.3 * semi, 0, 0};
      const double near_px = std::max(0.05, std::hypot(off.x, off.y) / 7);
      CHECK(error_px(ring_with(size).fit(picture.view(), kAtOrigin, {50, 45}), centre) < near_px);
    }
  }
}

TEST_CASE("the start is kept without bright pixels") {
  const Image<std::uint8_t> dark(100, 90);
  const auto fit = ring_with(kModelOfRow140).fit(dark.view(), kAtOrigin, {50, 45});
  CHECK(fit.position == Pixel{50, 45});
  CHECK(fit.score == 0);
}

TEST_CASE("a ring does not drift along an edge, and not beyond its limit") {
  Image<std::uint8_t> edge(100, 90);
  for (int y = 37; y <= 38; ++y) std::fill_n(edge.row(y), 100, std::uint8_t{255});
  // The ring's upper end lies at row 35: the edge pulls it down.
  const PuckSizeModel size{30, 0, 0, 20, 0, 0};
  const auto fit = ring_with(size).fit(edge.view(), kAtOrigin, {50, 45});
  CHECK(std::abs(fit.position.x - 50) < 0.05);
  CHECK(fit.position.y > 45.5);
  CHECK(fit.position.y <= 49);
}

}  // namespace puck
