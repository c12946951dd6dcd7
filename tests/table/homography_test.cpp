#include "common/table/homography.h"

#include <array>
#include <limits>
#include <stdexcept>

#include <doctest/doctest.h>

#include "tests/support/test_camera.h"

namespace puck {
namespace {

TEST_CASE(
    "The homography maps the camera's middle pixel to the axis's intersection with the table") {
  // The axis sinks 0.6 m within 0.6 / tan 30 degrees = 1.0392 m, from 0.6 m behind the end.
  const TablePoint point = *test_camera().to_table({320, 240});
  CHECK(point.x_m == doctest::Approx(0.43923));
  CHECK(point.y_m == doctest::Approx(0));
}

TEST_CASE("A pixel to the left of the image's middle lies at positive y on the table") {
  CHECK(test_camera().to_table({100, 240})->y_m > 0);
}

TEST_CASE("The homography maps there and back") {
  const Homography camera = test_camera();
  const Pixel pixel = *camera.to_image(*camera.to_table({123, 321}));
  CHECK(pixel.x == doctest::Approx(123));
  CHECK(pixel.y == doctest::Approx(321));
}

TEST_CASE("A pixel above the horizon and a point behind the camera map to nothing") {
  const Homography camera = test_camera();
  // The horizon lies 700 tan 30 degrees = 404 px above the middle.
  CHECK(camera.to_table({320, -160}).has_value());
  CHECK_FALSE(camera.to_table({320, -170}).has_value());
  CHECK_FALSE(camera.to_image({-3, 0}).has_value());
}

TEST_CASE("The sign of the coefficients does not matter") {
  std::array<double, 9> negative = test_camera().coefficients();
  for (double& coefficient : negative) coefficient = -coefficient;
  CHECK(Homography(negative).to_table({320, 240})->x_m == doctest::Approx(0.43923));
}

TEST_CASE("The Jacobian is the slope of the map") {
  const Homography camera = test_camera();
  const Matrix2 jacobian = camera.jacobian_at({200, 300});
  const TablePoint at = *camera.to_table({200, 300});
  const TablePoint right = *camera.to_table({200.001, 300});
  const TablePoint below = *camera.to_table({200, 300.001});
  CHECK(jacobian(0, 0) == doctest::Approx((right.x_m - at.x_m) / 0.001).epsilon(1e-4));
  CHECK(jacobian(0, 1) == doctest::Approx((below.x_m - at.x_m) / 0.001).epsilon(1e-4));
  CHECK(jacobian(1, 0) == doctest::Approx((right.y_m - at.y_m) / 0.001).epsilon(1e-4));
  CHECK(jacobian(1, 1) == doctest::Approx((below.y_m - at.y_m) / 0.001).epsilon(1e-4));
}

TEST_CASE("A homography that is singular or not finite is refused") {
  CHECK_THROWS_AS(Homography({1, 2, 3, 2, 4, 6, 0, 0, 1}), std::invalid_argument);
  CHECK_THROWS_AS(Homography({1, 0, 0, 0, 1, 0, 0, 0, std::numeric_limits<double>::quiet_NaN()}),
                  std::invalid_argument);
}

}  // namespace
}  // namespace puck
