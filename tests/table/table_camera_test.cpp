#include "common/table/table_camera.h"

#include <cmath>
#include <numbers>
#include <optional>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/support/test_camera.h"

namespace puck {
namespace {

// The camera of test_camera.
constexpr PinholeCamera kCamera{700, {320, 240}, {}};
constexpr double kDegree = std::numbers::pi / 180;

// 3 degrees further down than at home: the axis sinks 0.6 m on 0.6 / tan 33 degrees.
TEST_CASE("A camera that looks down sees the nearer table in its middle") {
  const TableCamera camera(test_camera(), kCamera);
  HeadPose down;
  down.pitch_deg = -3;
  const TableView view = *camera.view_at(down);
  CHECK(view.homography().to_table({320, 240})->x_m ==
        doctest::Approx(0.6 / std::tan(33 * kDegree) - 0.6));
}

TEST_CASE("At home a turning camera equals a fixed one") {
  const TableView view = *TableCamera(test_camera(), kCamera).view_at({});
  for (const Pixel pixel : {Pixel{0, 0}, Pixel{320, 240}, Pixel{639, 479}, Pixel{100, 400}}) {
    const TablePoint expected = *test_camera().to_table(pixel);
    const TablePoint point = *view.homography().to_table(pixel);
    CHECK(point.x_m == doctest::Approx(expected.x_m));
    CHECK(point.y_m == doctest::Approx(expected.y_m));
  }
}

TEST_CASE("Yaw to the right moves the table to the left in the image, roll turns it") {
  const TableCamera camera(test_camera(), kCamera);
  const TablePoint ahead = *test_camera().to_table({320, 240});
  HeadPose right;
  right.yaw_deg = 5;
  CHECK(camera.view_at(right)->homography().to_image(ahead)->x < 320 - 40);
  HeadPose clockwise;
  clockwise.roll_deg = 5;
  const TablePoint above = *test_camera().to_table({320, 140});
  const Pixel seen = *camera.view_at(clockwise)->homography().to_image(above);
  CHECK(seen.x == doctest::Approx(320 - 100 * std::sin(5 * kDegree)));
  CHECK(seen.y == doctest::Approx(240 - 100 * std::cos(5 * kDegree)));
}

TEST_CASE("With the table's origin behind it, a turned camera still sees the far end") {
  const TableCamera camera(test_camera(), kCamera);
  HeadPose up;
  up.pitch_deg = 28;
  const Homography homography = camera.view_at(up)->homography();
  const std::optional<Pixel> far = homography.to_image({2, 0.2});
  REQUIRE(far);
  CHECK(homography.to_table(*far)->x_m == doctest::Approx(2));
  HeadPose aside;
  aside.yaw_deg = 100;
  CHECK_FALSE(camera.view_at(aside)->homography().to_image({2, 0.2}).has_value());
}

TEST_CASE("A puck at rest stays at rest on the table while the camera turns") {
  const TableCamera camera(test_camera(), {700, {320, 240}, {0.02, 0.1, -0.08}});
  const auto pose_at = [](double t_s) {
    return HeadPose{2 + 20 * t_s, -1 - 8 * t_s, 0.5 + 5 * t_s, 20, -8, 5};
  };
  const TablePoint puck{1.2, -0.3};
  const auto seen_at = [&](double t_s) {
    return *camera.view_at(pose_at(t_s))->homography().to_image(puck);
  };
  constexpr double kStep = 1e-5;
  const Pixel before = seen_at(-kStep);
  const Pixel after = seen_at(kStep);
  ImageTrack seen{seen_at(0),
                  {(after.x - before.x) / (2 * kStep), (after.y - before.y) / (2 * kStep)}};
  CHECK(std::hypot(seen.velocity.x, seen.velocity.y) > 200);
  const PuckTrack track = *camera.view_at(pose_at(0))->to_table(seen);
  CHECK(track.state.position.x_m == doctest::Approx(1.2));
  CHECK(track.state.position.y_m == doctest::Approx(-0.3));
  CHECK(std::hypot(track.state.velocity.x_m_s, track.state.velocity.y_m_s) < 1e-5);
  // Without the head's speeds it appears to move.
  HeadPose still = pose_at(0);
  still.yaw_deg_s = still.pitch_deg_s = still.roll_deg_s = 0;
  const TableVelocity apparent = camera.view_at(still)->to_table(seen)->state.velocity;
  CHECK(std::hypot(apparent.x_m_s, apparent.y_m_s) > 0.3);
}

TEST_CASE("A head that turns about its neck moves the camera, too") {
  // The pivot lies 10 cm behind the camera, so that it is carried to the right with the yaw.
  const TableCamera about_neck(test_camera(), {700, {320, 240}, {0, 0, -0.1}});
  HeadPose right;
  right.yaw_deg = 3;
  const TablePoint ahead = *test_camera().to_table({320, 240});
  const Pixel turned =
      *TableCamera(test_camera(), kCamera).view_at(right)->homography().to_image(ahead);
  const Pixel moved = *about_neck.view_at(right)->homography().to_image(ahead);
  // 0.1 sin 3 degrees to the side, seen from 1.2 m.
  CHECK(moved.x - turned.x ==
        doctest::Approx(-700 * 0.1 * std::sin(3 * kDegree) / 1.2).epsilon(0.02));
  CHECK(moved.y == doctest::Approx(turned.y).epsilon(0.001));
}

TEST_CASE("The plane above the table is nearer to the camera") {
  // Of a point 6 mm above the surface the camera's ray goes on to the surface: 0.6 m up, at x from
  // 0.6 m behind the end, by similar triangles 0.594 / 0.6 of the way.
  const Homography raised = TableCamera(test_camera(), kCamera).raised(0.006);
  for (const Pixel pixel : {Pixel{320, 240}, Pixel{120, 400}, Pixel{600, 20}}) {
    const TablePoint on_surface = *test_camera().to_table(pixel);
    const TablePoint above = *raised.to_table(pixel);
    CHECK(above.x_m + 0.6 == doctest::Approx((on_surface.x_m + 0.6) * 0.99));
    CHECK(above.y_m == doctest::Approx(on_surface.y_m * 0.99));
  }
  CHECK_THROWS_AS(TableCamera(test_camera(), kCamera).raised(0.6), std::invalid_argument);
}

TEST_CASE("Camera values out of range are refused by name") {
  CHECK_THROWS_WITH_AS(TableCamera(test_camera(), {0, {320, 240}, {}}),
                       "camera.focal_px must be between 10 and 100000, got 0",
                       std::invalid_argument);
  CHECK_THROWS_AS(TableCamera(test_camera(), {700, {320, 240}, {0, 11, 0}}), std::invalid_argument);
}

}  // namespace
}  // namespace puck
