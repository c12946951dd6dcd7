#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "common/simulation/camera_view.h"
#include "common/simulation/head_motion.h"
#include "common/simulation/world_view.h"
#include "common/table/head_track.h"
#include "common/table/table_camera.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{640, 480};
constexpr double kHalfPuckM = 0.006;

TEST_CASE("A turned table camera sees the same as the simulated camera") {
  const CameraView home(CameraParams{}, kSensor);
  const TableCamera camera(home.table_from_image(0), {home.focal_px(), home.principal_point(), {}});
  for (const HeadPose pose : {HeadPose{3, -1, 0.5}, HeadPose{-20, 10, -8}, HeadPose{0, 0, 30}}) {
    const CameraView turned = home.turned(pose);
    const Homography followed = camera.view_at(pose)->homography();
    for (const TablePoint point : {TablePoint{0.5, 0.3}, {1.2, -0.4}, {2, 0}}) {
      const Pixel expected = turned.project({point.x_m, point.y_m, 0})->pixel;
      CHECK(followed.to_image(point)->x == doctest::Approx(expected.x));
      CHECK(followed.to_image(point)->y == doctest::Approx(expected.y));
    }
  }
  const Homography raised = camera.raised(kHalfPuckM);
  CHECK(raised.to_image({1.5, 0.2})->y ==
        doctest::Approx(home.project({1.5, 0.2, kHalfPuckM})->pixel.y));
}

// Error of the place on the table, from the true place of the puck's outline in the image and HEADs
// every `period_us`, `late_us` late; mm.
struct Errors {
  double median_mm = 0;
  double worst_mm = 0;
};
Errors errors_of(bool follows, std::int64_t period_us, std::int64_t late_us) {
  const CameraView home(CameraParams{}, kSensor);
  const TableGeometry table;
  const WorldView world(table, SceneParams{}, kSensor);
  const TableCamera camera(home.table_from_image(kHalfPuckM),
                           {home.focal_px(), home.principal_point(), {}});
  const HeadMotion motion(HeadMotionParams{}, Random(1, 20));
  const auto pose_at = [&](std::int64_t us) {
    return motion.pose_at(static_cast<double>(us) * 1e-6);
  };
  HeadTrack head;
  std::vector<double> errors;
  std::int64_t next_head_us = 0;
  for (std::int64_t us = 0; us < 10'000'000; us += 1000) {
    for (; next_head_us + late_us <= us; next_head_us += period_us) {
      head.add({next_head_us}, pose_at(next_head_us));
    }
    const double t_s = static_cast<double>(us) * 1e-6;
    const TablePoint puck{1.15 + 0.8 * std::sin(1.7 * t_s), 0.5 * std::sin(2.9 * t_s)};
    const Pixel seen = world.puck_box(puck, home.turned(pose_at(us))).centre;
    const auto pose = head.at({us});
    if (follows && !pose) continue;
    const auto place = camera.view_at(follows ? *pose : HeadPose{})->homography().to_table(seen);
    REQUIRE(place);
    errors.push_back(1e3 * std::hypot(place->x_m - puck.x_m, place->y_m - puck.y_m));
  }
  REQUIRE(errors.size() > 9'900);
  std::sort(errors.begin(), errors.end());
  return {errors[errors.size() / 2], errors.back()};
}

TEST_CASE("The puck's place on the table is known to a millimetre while the head moves") {
  const Errors ignored = errors_of(false, 1000, 0);
  MESSAGE("head not followed: median ", ignored.median_mm, " mm, worst ", ignored.worst_mm, " mm");
  CHECK(ignored.median_mm > 10);
  const Errors still = errors_of(true, 1000, 0);
  MESSAGE("HEAD at 1000 Hz: median ", still.median_mm, " mm, worst ", still.worst_mm, " mm");
  CHECK(still.median_mm < 0.7);
  CHECK(still.worst_mm < 1);
  const Errors late = errors_of(true, 1000, 2000);
  MESSAGE("HEAD at 1000 Hz, 2 ms late: median ", late.median_mm, " mm, worst ", late.worst_mm);
  CHECK(late.worst_mm < 1.1);
  const Errors slow = errors_of(true, 5000, 1000);
  MESSAGE("HEAD at 200 Hz, 1 ms late: median ", slow.median_mm, " mm, worst ", slow.worst_mm);
  CHECK(slow.worst_mm < 1.5);
}

}  // namespace
}  // namespace puck
