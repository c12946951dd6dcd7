#include "common/vision/contour/puck_contour.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr SensorSize kOddWidthSensor{641, 480};
constexpr PuckSizeModel kFlat{30, 0, 0, 20, 0, 0};
// The horizon is at row −200.
constexpr PuckSizeModel kPlane{20, 0, 0.1, 10, 0, 0.1};
// The same horizon.
constexpr DiscModel kDisc{.width_0 = 20,
                          .width_y = 0.1,
                          .face_on_px = 60,
                          .thickness = 0.2,
                          .principal_x_px = 320,
                          .principal_y_px = 239.5};
constexpr ContourCalibration kExact{0, 0, 0};

TEST_CASE("The distance from the contour is exact along the axes and outward normals are unit") {
  const ContourRing ring = PuckContour(kOddWidthSensor, kFlat, kExact).ring_at({320, 240}, 0);
  CHECK(ring.offset(18, 0, 0).distance_px == doctest::Approx(3));
  CHECK(ring.offset(18, 0, 0).normal_x == doctest::Approx(1));
  CHECK(ring.offset(0, -8, 0).distance_px == doctest::Approx(-2));
  CHECK(ring.offset(0, -8, 0).normal_y == doctest::Approx(-1));
  CHECK(ring.offset(16, 0, 1).distance_px == doctest::Approx(0));
  const ContourOffset oblique = ring.offset(9, 7, 0);
  CHECK(std::hypot(oblique.normal_x, oblique.normal_y) == doctest::Approx(1));
}

TEST_CASE("The centre of a ring lies inside, even with straight sides") {
  CHECK(ContourRing{.semi_x = 15, .semi_y = 8}.offset(0, 0, 0).distance_px < -8);
  const ContourRing drawn_out{.semi_x = 15, .semi_y = 8, .half_wall = 3};
  for (const double dy : {-2.9, 0.0, 2.9}) {
    CHECK(drawn_out.offset(0, dy, 0).distance_px < -5);
  }
}

TEST_CASE("The twelve sectors of a ring cover 30 degrees each") {
  const ContourRing ring = PuckContour(kOddWidthSensor, kFlat, kExact).ring_at({320, 240}, 0);
  std::array<int, kContourSectors> counts{};
  for (int degree = 0; degree < 360; ++degree) {
    const double angle = (degree + 0.5) * std::numbers::pi / 180;
    ++counts[static_cast<std::size_t>(
        ring.offset(15 * std::cos(angle), 10 * std::sin(angle), 0).sector)];
  }
  for (const int count : counts) CHECK(count == 30);
}

TEST_CASE("Beside the middle the ring is sheared by perspective, and keeps its width") {
  const PuckContour contour(kOddWidthSensor, kPlane, kExact);
  const Pixel beside{520, 200};
  const ContourRing ring = contour.ring_at(beside, 0);
  // The horizon is at row −200, the middle at column 320: 200 px aside, 400 px below.
  const double flat_share = (30 - 0.165 * 40) / 30;
  CHECK(ring.shear == doctest::Approx(0.5 * flat_share));
  CHECK(std::hypot(ring.semi_x, ring.shear * ring.semi_y) == doctest::Approx(20));
  CHECK(contour.ring_at({320, 200}, 0).shear == doctest::Approx(0));
}

TEST_CASE("Without a slope in the size model there is no horizon and no shear") {
  CHECK(PuckContour(kOddWidthSensor, kFlat, kExact).ring_at({600, 240}, 0).shear == 0);
}

TEST_CASE("An ellipse rotated in its box equals the ring of that box and lean") {
  constexpr double kLong = 18;
  constexpr double kShort = 9;
  constexpr double kLean_deg = -25;
  const double lean = kLean_deg * std::numbers::pi / 180;
  const auto at = [&](double angle) {
    const double along = kLong * std::cos(angle);
    const double across = kShort * std::sin(angle);
    return Pixel{along * std::cos(lean) - across * std::sin(lean),
                 along * std::sin(lean) + across * std::cos(lean)};
  };
  PuckSizeModel box;
  box.width_0 = 2 * std::hypot(kLong * std::cos(lean), kShort * std::sin(lean));
  box.height_0 = 2 * std::hypot(kLong * std::sin(lean), kShort * std::cos(lean));
  ContourCalibration calibration = kExact;
  calibration.lean_deg = kLean_deg;
  const ContourRing ring = PuckContour(kOddWidthSensor, box, calibration).ring_at({320, 240}, 0);
  for (int i = 0; i < 12; ++i) {
    const Pixel place = at(2 * std::numbers::pi * i / 12);
    CHECK(ring.offset(place.x, place.y, 0).distance_px == doctest::Approx(0));
  }
  CHECK(ring.offset(at(0).x, -at(0).y, 0).distance_px > 4);
}

TEST_CASE("A ring with a lean too large for its box stays within the box") {
  for (const PuckSize size : {PuckSize{33, 23}, {20, 5}, {4, 3}}) {
    CAPTURE(size.width);
    PuckSizeModel box;
    box.width_0 = size.width;
    box.height_0 = size.height;
    for (const double wall_share : {0.0, 0.165}) {
      ContourCalibration calibration = kExact;
      calibration.lean_deg = 40;
      const ContourRing ring =
          PuckContour(kOddWidthSensor, box, calibration).ring_at({320, 240}, wall_share);
      CHECK(ring.semi_x >= 2);
      CHECK(std::hypot(ring.semi_x, ring.shear * ring.semi_y) <=
            doctest::Approx(std::max(size.width / 2, 2.0)));
    }
  }
}

TEST_CASE("Where the disc is known, horizon and sizes are the disc's") {
  PuckSizeModel model = kFlat;
  model.disc = kDisc;
  const PuckSize size = model.disc->at({600, 240});
  const ContourRing ring = PuckContour(kOddWidthSensor, model, kExact).ring_at({600, 240}, 0);
  CHECK(ring.semi_y == doctest::Approx(size.height / 2));
  // The width is zero at row -200; the side wall is not sheared.
  const double of_disc = (size.height - model.wall_of_width() * size.width) / size.height;
  CHECK(ring.shear == doctest::Approx((600 - 320.0) / 440 * of_disc));
}

TEST_CASE("A side wall without events leaves a lower ring, higher up") {
  const ContourRing ring =
      PuckContour(kOddWidthSensor, kFlat, {0, 0.2, 1}).ring_at({320, 240}, 0.2);
  CHECK(ring.semi_x == doctest::Approx(15.5));
  CHECK(ring.semi_y == doctest::Approx((21 - 0.2 * 31) / 2));
  CHECK(ring.rise == doctest::Approx(0.1 * 31));
}

TEST_CASE("The other assumption on the side wall is the opposite of the calibrated one") {
  CHECK(PuckContour(kOddWidthSensor, kFlat, {0, 0, 0}).other_wall_share() > 0.1);
  CHECK(PuckContour(kOddWidthSensor, kFlat, {0, 0.15, 0}).other_wall_share() == 0);
  CHECK(PuckContour(kOddWidthSensor, kFlat, {0, -0.15, 0}).other_wall_share() == 0);
}

TEST_CASE("The other assumption on the side wall depends on the annotations' outline") {
  PuckSizeModel model = kFlat;
  model.disc = kDisc;
  const double tilted = std::cos(model.disc->tilt_deg() * std::numbers::pi / 180);
  CHECK(PuckContour(kOddWidthSensor, model, kExact).other_wall_share() ==
        doctest::Approx(0.2 * tilted));

  // A wall in the calibration is not omitted, however thin.
  model.disc->thickness = 0.1;
  const double thin = model.wall_of_width();
  CHECK(PuckContour(kOddWidthSensor, model, {0, thin, 0}).other_wall_share() == 0);

  // Annotations of the face alone: the wall extends below it, and the face's upper edge stays.
  model.disc->thickness = 0.03;
  const PuckContour contour(kOddWidthSensor, model, kExact);
  const ContourRing face = contour.ring_at({320, 240}, 0);
  const ContourRing both = contour.ring_at({320, 240}, contour.other_wall_share());
  CHECK(both.semi_y > face.semi_y + 2);
  CHECK(both.rise + both.semi_y == doctest::Approx(face.semi_y));
}

// The ellipse's point farthest to the side, px along y per px along x.
double face_sides_slope(const ContourRing& face) {
  const double slanted = face.shear * face.semi_y;
  return slanted * face.semi_y / (face.semi_x * face.semi_x + slanted * slanted);
}

TEST_CASE("A wall visible below the face extends its outline downwards") {
  PuckSizeModel model = kFlat;
  model.disc = kDisc;
  model.disc->thickness = 0;
  const PuckContour contour(kOddWidthSensor, model, {0, -0.3, 0});
  for (const Pixel centre : {Pixel{320, 240}, {600, 240}, {20, 300}}) {
    CAPTURE(centre.x);
    const ContourRing face = contour.ring_at(centre, 0);
    const ContourRing whole = contour.ring_at(centre, -0.3);
    const double wall_px = 0.3 * contour.size_at(centre).width;
    const auto distance_px = [&](const ContourRing& ring, double dx, double dy) {
      return ring.offset(dx, dy, 0).distance_px;
    };
    // Points above the ends of the face's width stay, the others move down by the wall's height.
    // The sides between them are straight.
    for (int i = 0; i < 24; ++i) {
      CAPTURE(i);
      const double angle = 2 * std::numbers::pi * (i + 0.5) / 24;
      const double y = face.semi_y * std::sin(angle);
      const double x = face.semi_x * std::cos(angle) + face.shear * y;
      CHECK(distance_px(face, x, y) == doctest::Approx(0));
      const double below = y > face_sides_slope(face) * x ? wall_px : 0;
      CHECK(distance_px(whole, x, y + below) == doctest::Approx(0));
    }
    const double half_width = std::hypot(face.semi_x, face.shear * face.semi_y);
    for (const double side : {-1, 1}) {
      const double end_y = side * face_sides_slope(face) * half_width;
      for (int i = 1; i < 4; ++i) {
        const ContourOffset place =
            whole.offset(side * (half_width + 0.5), end_y + wall_px * i / 4, 0);
        CHECK(place.distance_px == doctest::Approx(0.5).epsilon(0.05));
        CHECK(place.normal_x == doctest::Approx(side).epsilon(0.01));
        CHECK(std::abs(place.normal_y) < 0.05);
      }
    }
    // Its areas, counted on a fine grid.
    constexpr double kStep = 0.25;
    double inside = 0;
    double reach = 0;
    for (double dy = -40; dy < 50; dy += kStep) {
      for (double dx = -40; dx < 40; dx += kStep) {
        const double d = distance_px(whole, dx, dy);
        inside += d < -1 ? kStep * kStep : 0;
        reach += d < 5 ? kStep * kStep : 0;
      }
    }
    CHECK(whole.inside_area(1) == doctest::Approx(inside).epsilon(0.04));
    CHECK(whole.reach_area(5) == doctest::Approx(reach).epsilon(0.04));
  }
}

TEST_CASE("An omitted wall has an ordinary puck's height, scaled by its place") {
  PuckSizeModel model = kFlat;
  model.disc = kDisc;
  model.disc->thickness = 0;
  const PuckContour contour(kOddWidthSensor, model, kExact);
  const double share = contour.other_wall_share();
  CHECK(share == -model.ordinary_wall());
  CHECK(contour.is_other_wall(share));
  for (const Pixel place : {Pixel{320, 60}, {320, 240}, {320, 420}}) {
    CAPTURE(place.y);
    const ContourRing ring = contour.ring_at(place, share);
    const PuckSize size = model.disc->at(place);
    const double wall = model.ordinary_wall() * model.disc->wall_profile(place);
    CHECK(2 * ring.semi_y == doctest::Approx(size.height + wall * size.width));
    // The larger the rise, the lower the centre.
    const Pixel lower = contour.centre_with_wall(place, 0, share);
    CHECK(place.y - lower.y == doctest::Approx(-ring.rise));
  }
  // A calibrated share applies to the whole image.
  const PuckContour calibrated(kOddWidthSensor, model, {0, -0.2, 0});
  for (const Pixel place : {Pixel{320, 60}, {320, 420}}) {
    CHECK(calibrated.ring_at(place, -0.2).rise ==
          doctest::Approx(-0.1 * calibrated.size_at(place).width));
  }
}

TEST_CASE("A size model without any size still gives a ring") {
  const PuckContour contour(kOddWidthSensor, {-50, 0, 0, -20, 0, 0}, kExact);
  const ContourRing ring = contour.ring_at({320, 240}, 0);
  CHECK(ring.semi_x >= 1);
  CHECK(ring.semi_y >= 1);
  CHECK(std::isfinite(ring.offset(0, 0, 0).distance_px));
}

}  // namespace
}  // namespace puck
