#include "common/vision/geometry/puck_size_model.h"

#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "tests/vision/test_sensor.h"

namespace puck {
namespace {

using test::kSensor;

TEST_CASE("the size model is linear between its limits and clamped to them") {
  PuckSizeModel model{10, 0.01, 0.1, 5, 0, 0.1};
  model.smallest = {20, 4};
  model.largest = {40, 50};
  CHECK(model.at({100, 200}).width == 31);
  CHECK(model.at({100, 200}).height == 25);
  CHECK(model.at({0, 0}).width == 20);
  CHECK(model.at({0, 0}).height == 5);
  CHECK(model.at({0, 450}).width == 40);
  CHECK(model.extrapolated_at({0, 450}).width == 55);
}

TEST_CASE("every size is a number of at least 1 px, for any coefficients") {
  const double nan = std::nan("");
  for (const PuckSizeModel& model :
       {PuckSizeModel{nan, 0, 0, nan, 0, 0}, PuckSizeModel{-9, 0, 0, -1e9, 0, 0}}) {
    CHECK(model.at({320, 240}).width == 3);
    CHECK(model.at({320, 240}).height == 3);
  }
  CHECK(PuckSizeModel{1e9, 0, 0, 0, 0, 1e9}.at({320, 240}).width == 512);
}

TEST_CASE("where the disc is known the size is the disc's, clamped to the same limits") {
  PuckSizeModel model{10, 0, 0, 5, 0, 0};
  model.disc = DiscModel{.width_0 = 20, .width_y = 0.1, .face_on_px = 80};
  // Without thickness, straight below the optical axis: w and w² / face_on.
  CHECK(model.at({0, 200}).width == doctest::Approx(40));
  CHECK(model.at({0, 200}).height == doctest::Approx(20));
  model.unseen_of_width = 0.1;
  CHECK(model.at({0, 200}).width == doctest::Approx(40));
  CHECK(model.at({0, 200}).height == doctest::Approx(16));
  model.largest = {35, 15};
  CHECK(model.at({0, 200}).width == 35);
  CHECK(model.at({0, 200}).height == 15);
  model.disc.reset();
  CHECK(model.at({0, 200}).height == doctest::Approx(4));
}

TEST_CASE("the side wall's share of the height is the disc's, an ordinary puck's or zero") {
  PuckSizeModel model{10, 0, 0, 5, 0, 0};
  CHECK(model.wall_of_width() == doctest::Approx(0.165));
  // From 30° above: half as high as wide in the middle.
  model.disc = DiscModel{.width_0 = 16,
                         .width_y = 0.1,
                         .face_on_px = 80,
                         .thickness = 0.2,
                         .principal_x_px = 320,
                         .principal_y_px = 240};
  CHECK(model.wall_of_width() == doctest::Approx(0.2 * std::sqrt(0.75)));
  model.disc->thickness = 0.05;
  CHECK(model.wall_of_width() > 0);
  model.disc->thickness = 0.049;
  CHECK(model.wall_of_width() == 0);
}

TEST_CASE("a wall's share of the width grows with the distance, as the disc's heights do") {
  DiscModel thick{.width_0 = 16,
                  .width_y = 0.1,
                  .face_on_px = 80,
                  .thickness = 0.2,
                  .principal_x_px = 320,
                  .principal_y_px = 240};
  DiscModel flat = thick;
  flat.thickness = 0;
  CHECK(thick.wall_profile({320, 240}) == doctest::Approx(1));
  CHECK(flat.wall_profile({320, 100}) > 1.1);
  for (const double y : {20.0, 240.0, 460.0}) {
    const Pixel place{320, y};
    const double wall = (thick.at(place).height - flat.at(place).height) / flat.at(place).width;
    CHECK(thick.wall_of_width() * flat.wall_profile(place) == doctest::Approx(wall));
  }
}

TEST_CASE("a size model that fits the sensor gives no warning") {
  PuckSizeModel model{16, 0, 0.07, 5.6, 0, 0.07};
  CHECK(doubts_about(model, kSensor).empty());
  model.sensor = kSensor;
  CHECK(doubts_about(model, kSensor).empty());
}

TEST_CASE("a size model clamped inside the image names the worst place and the sizes there") {
  const PuckSizeModel model{-10, 0, 0.1, -2, 0.01, 0.07};
  const auto doubts = doubts_about(model, kSensor);
  REQUIRE(doubts.size() == 1);
  CHECK(doubts[0].find("-10.0 x -2.0 px at (0, 0), where 3.0 x 3.0 px") != std::string::npos);
  const PuckSizeModel none{std::nan(""), 0, 0, 20, 0, 0};
  CHECK(doubts_about(none, kSensor).size() == 1);
}

TEST_CASE("a size model of another sensor gives a warning") {
  PuckSizeModel model{16, 0, 0.01, 6, 0, 0.01};
  model.sensor = {1280, 720};
  const auto doubts = doubts_about(model, kSensor);
  REQUIRE(doubts.size() == 1);
  CHECK(doubts[0].find("for a sensor of 1280x720 px, this one has 640x480") != std::string::npos);
}

}  // namespace
}  // namespace puck
