#include "common/table/table_view.h"

#include <array>
#include <cmath>
#include <cstddef>

#include <doctest/doctest.h>

#include "common/table/table_camera.h"
#include "tests/support/test_camera.h"

namespace puck {
namespace {

// A view of a turned and turning head.
TableView turning_view() {
  const TableCamera camera(test_camera(), {700, {320, 240}, {0, 0.1, -0.05}});
  return *camera.view_at({3, -1, 0.5, 25, -10, 6});
}

const ImageTrack kSeen{{210, 180}, {-300, 450}, {}};

std::array<double, 4> numbers_of(const PuckTrack& track) {
  const auto& [position, velocity] = track.state;
  return {position.x_m, position.y_m, velocity.x_m_s, velocity.y_m_s};
}

TEST_CASE("A still camera transforms velocities by the homography's slope") {
  const TableView view(test_camera());
  const PuckTrack track = *view.to_table(kSeen);
  const Pixel next{kSeen.position.x + 1e-6 * kSeen.velocity.x,
                   kSeen.position.y + 1e-6 * kSeen.velocity.y};
  const TablePoint after = *test_camera().to_table(next);
  CHECK(track.state.velocity.x_m_s ==
        doctest::Approx((after.x_m - track.state.position.x_m) * 1e6).epsilon(1e-4));
  CHECK(track.state.velocity.y_m_s ==
        doctest::Approx((after.y_m - track.state.position.y_m) * 1e6).epsilon(1e-4));
}

TEST_CASE("The covariance is transformed by the map's exact slope, velocities included") {
  const TableView view = turning_view();
  const std::array<double, 4> steps{1e-3, 1e-3, 1e-2, 1e-2};
  Matrix4 slope;
  for (int column = 0; column < 4; ++column) {
    const auto moved = [&](double by) {
      ImageTrack seen = kSeen;
      if (column == 0) seen.position.x += by;
      if (column == 1) seen.position.y += by;
      if (column == 2) seen.velocity.x += by;
      if (column == 3) seen.velocity.y += by;
      return numbers_of(*view.to_table(seen));
    };
    const auto after = moved(steps[static_cast<std::size_t>(column)]);
    const auto before = moved(-steps[static_cast<std::size_t>(column)]);
    for (std::size_t row = 0; row < 4; ++row) {
      slope(static_cast<int>(row), column) =
          (after[row] - before[row]) / (2 * steps[static_cast<std::size_t>(column)]);
    }
  }
  ImageTrack seen = kSeen;
  seen.covariance =
      Matrix4{{0.04, 0.01, 0.5, 0}, {0.01, 0.09, 0, 0.3}, {0.5, 0, 900, 50}, {0, 0.3, 50, 400}};
  const Matrix4 expected = carried(slope, seen.covariance);
  const Matrix4 covariance = view.to_table(seen)->covariance;
  for (int i = 0; i < 16; ++i) {
    CAPTURE(i);
    CHECK(covariance(i) == doctest::Approx(expected(i)).epsilon(1e-5));
  }
}

TEST_CASE("A pixel above the horizon has no place on the table") {
  ImageTrack seen = kSeen;
  seen.position = {320, -300};
  CHECK_FALSE(turning_view().to_table(seen));
}

}  // namespace
}  // namespace puck
