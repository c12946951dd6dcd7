#include "common/simulation/camera_view.h"

#include <cmath>

#include <doctest/doctest.h>

#include "common/simulation/convex_outline.h"
#include "common/simulation/projected_shape.h"

namespace puck {
namespace {

constexpr SensorSize kSize{640, 480};

}  // namespace

TEST_CASE("The camera's target lies in the middle of the image") {
  const CameraParams params;
  const CameraView view(params, kSize);
  const double pitch = params.pitch_deg * M_PI / 180;
  const auto seen = view.project({-params.behind_m + params.height_m / std::tan(pitch), 0, 0});
  REQUIRE(seen);
  CHECK(seen->pixel.x == doctest::Approx(319.5));
  CHECK(seen->pixel.y == doctest::Approx(239.5));
  CHECK(seen->depth_m == doctest::Approx(params.height_m / std::sin(pitch)));
}

TEST_CASE("The robot's left is left in the image, and farther is higher") {
  const CameraView view({}, kSize);
  const auto middle = view.project({1, 0, 0});
  CHECK(view.project({1, 0.3, 0})->pixel.x < middle->pixel.x);
  CHECK(view.project({1.5, 0, 0})->pixel.y < middle->pixel.y);
  CHECK_FALSE(view.project({-2, 0, 0}));
}

TEST_CASE("The homography of a plane agrees with the projection") {
  const CameraView home({}, kSize);
  for (const double height_m : {0.0, 0.006, 0.1}) {
    const Homography table_from_image = home.table_from_image(height_m);
    for (const double x_m : {0.1, 1.0, 2.0}) {
      for (const double y_m : {-0.5, 0.0, 0.4}) {
        const auto point = table_from_image.to_table(home.project({x_m, y_m, height_m})->pixel);
        REQUIRE(point);
        CHECK(point->x_m == doctest::Approx(x_m).epsilon(1e-9));
        CHECK(point->y_m == doctest::Approx(y_m).epsilon(1e-9));
      }
    }
  }
}

TEST_CASE("A head that turns right, up or clockwise moves the image the other way") {
  const CameraView home({}, kSize);
  const Pixel still = home.project({1, 0, 0})->pixel;
  HeadPose pose;
  pose.yaw_deg = 2;
  const Pixel yawed = home.turned(pose).project({1, 0, 0})->pixel;
  CHECK(yawed.x < still.x - 20);
  pose = {};
  pose.pitch_deg = 2;
  const Pixel pitched = home.turned(pose).project({1, 0, 0})->pixel;
  CHECK(pitched.y > still.y + 20);
  CHECK(pitched.x == doctest::Approx(still.x));
  pose = {};
  pose.roll_deg = 2;
  const Pixel right = home.project({1, -0.4, 0})->pixel;
  const Pixel rolled = home.turned(pose).project({1, -0.4, 0})->pixel;
  CHECK(rolled.y < right.y - 3);
}

TEST_CASE("The box around a cylinder touches all points of its rims") {
  const CameraView view({}, kSize);
  const ProjectedCylinder puck(view, {0.7, 0.3}, 0.0325, 0, 0.012);
  double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
  for (int i = 0; i < 10'000; ++i) {
    const double angle = 2 * M_PI * i / 10'000;
    for (const double z_m : {0.0, 0.012}) {
      const auto seen =
          view.project({0.7 + 0.0325 * std::cos(angle), 0.3 + 0.0325 * std::sin(angle), z_m});
      left = std::min(left, seen->pixel.x);
      right = std::max(right, seen->pixel.x);
      top = std::min(top, seen->pixel.y);
      bottom = std::max(bottom, seen->pixel.y);
    }
  }
  CHECK(puck.box().size.width == doctest::Approx(right - left).epsilon(1e-5));
  CHECK(puck.box().size.height == doctest::Approx(bottom - top).epsilon(1e-5));
  CHECK(puck.box().centre.x == doctest::Approx((left + right) / 2).epsilon(1e-6));
  CHECK(puck.box().centre.y == doctest::Approx((top + bottom) / 2).epsilon(1e-6));
}

TEST_CASE("Pixels outside an outline are bare and those inside it covered") {
  const CameraView view({}, kSize);
  const ProjectedCylinder mallet(view, {0.2, 0.1}, 0.05, 0, 0.03);
  const ProjectedCapsule arm(view, {0.2, 0.1, 0.07}, 0.03, {-0.1, -0.1, 0.2}, 0.035);
  const auto check_shape = [](const auto& shape) {
    int inside = 0;
    for (int y = 0; y < 480; ++y) {
      const Columns touched = shape.outline().touched(y);
      const Columns covered = shape.outline().inside(y);
      for (int x = 0; x < 640; ++x) {
        float share = 0;
        shape.coverage(y, x, 1, &share);
        if (x < touched.begin || x >= touched.end) REQUIRE(share == 0.0f);
        if (x >= covered.begin && x < covered.end) {
          REQUIRE(share == 1.0f);
          ++inside;
        }
      }
    }
    return inside;
  };
  CHECK(check_shape(mallet) > 1500);
  CHECK(check_shape(arm) > 3000);
}

TEST_CASE("The covered area of a cylinder is that of its ellipse") {
  const CameraView view({}, kSize);
  const ProjectedCylinder disc(view, {1, 0}, 0.0325, 0, 0);
  double area = 0;
  for (int y = 0; y < 480; ++y) {
    for (int x = 250; x < 400; ++x) {
      float share = 0;
      disc.coverage(y, x, 1, &share);
      area += share;
    }
  }
  const double expected = M_PI / 4 * disc.box().size.width * disc.box().size.height;
  CHECK(area == doctest::Approx(expected).epsilon(0.01));
}

}  // namespace puck
