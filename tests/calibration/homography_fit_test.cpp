#include "common/calibration/homography_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

#include "tests/support/test_camera.h"

namespace puck {
namespace {

std::vector<Correspondence> correspondences_of(const Homography& homography,
                                               const std::vector<TablePoint>& points) {
  std::vector<Correspondence> correspondences;
  for (const TablePoint point : points) {
    correspondences.push_back({*homography.to_image(point), point});
  }
  return correspondences;
}

const std::vector<TablePoint> kCorners{{0.2, -0.4}, {0.2, 0.4}, {2.0, -0.5}, {2.0, 0.5}};

TEST_CASE("The table fit recovers the homography from four exact correspondences") {
  const Homography truth = test_camera();
  const HomographyFit fit = fit_homography(correspondences_of(truth, kCorners));
  CHECK(fit.max_px < 1e-6);
  CHECK(fit.max_m < 1e-9);
  const TablePoint elsewhere{1.1, 0.13};
  const TablePoint mapped = *fit.homography.to_table(*truth.to_image(elsewhere));
  CHECK(mapped.x_m == doctest::Approx(1.1));
  CHECK(mapped.y_m == doctest::Approx(0.13));
}

TEST_CASE("The table fit averages the marking's error and reports it in pixels and metres") {
  const Homography truth = test_camera();
  std::vector<TablePoint> points;
  for (double x = 0.2; x < 2.1; x += 0.3) {
    for (double y = -0.5; y < 0.6; y += 0.25) points.push_back({x, y});
  }
  std::vector<Correspondence> noisy = correspondences_of(truth, points);
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 1);
  for (Correspondence& c : noisy) c.image = {c.image.x + noise(random), c.image.y + noise(random)};
  const HomographyFit fit = fit_homography(noisy);
  // Two coordinates of unit variance, less what the eight parameters explain: just below sqrt(2).
  CHECK(fit.rms_px > 1.0);
  CHECK(fit.rms_px < 1.6);
  CHECK(fit.max_px > fit.rms_px);
  CHECK(fit.max_m > fit.rms_m);
  double worst_px = 0;
  for (const TablePoint point : points) {
    const Pixel exact = *truth.to_image(point);
    const Pixel fitted = *fit.homography.to_image(point);
    worst_px = std::max(worst_px, std::hypot(exact.x - fitted.x, exact.y - fitted.y));
  }
  CHECK(worst_px < 1.5);
}

TEST_CASE("The refinement is a minimum: no small change of the fit reduces the residuals") {
  const Homography truth = test_camera();
  std::vector<Correspondence> marked = correspondences_of(
      truth, {{0.2, -0.4}, {0.2, 0.4}, {2.0, -0.5}, {2.0, 0.5}, {1, 0}, {1.4, 0.3}});
  marked[4].image.x += 3;
  marked[5].image.y -= 2;
  const auto cost = [&](const Homography& homography) {
    double sum = 0;
    for (const Correspondence& c : marked) {
      const Pixel p = *homography.to_image(c.table);
      sum += (p.x - c.image.x) * (p.x - c.image.x) + (p.y - c.image.y) * (p.y - c.image.y);
    }
    return sum;
  };
  const HomographyFit fit = fit_homography(marked);
  const double best = cost(fit.homography);
  for (std::size_t i = 0; i < 9; ++i) {
    for (const double factor : {1 - 1e-4, 1 + 1e-4}) {
      std::array<double, 9> changed = fit.homography.coefficients();
      changed[i] *= factor;
      CHECK(cost(Homography(changed)) >= best * (1 - 1e-9));
    }
  }
}

TEST_CASE("The table fit refuses fewer than four correspondences") {
  std::vector<Correspondence> three = correspondences_of(test_camera(), kCorners);
  three.resize(3);
  CHECK_THROWS_WITH_AS(fit_homography(three), "the table needs at least 4 correspondences, got 3",
                       std::invalid_argument);
}

TEST_CASE("The table fit refuses points on one line, three of four on one line, and equal points") {
  const Homography truth = test_camera();
  const auto refused = [&](const std::vector<TablePoint>& points) {
    CHECK_THROWS_AS(fit_homography(correspondences_of(truth, points)), std::invalid_argument);
  };
  refused({{0.2, 0}, {0.6, 0}, {1.0, 0}, {1.4, 0}, {1.9, 0}});
  refused({{0.2, -0.4}, {0.2, 0}, {0.2, 0.4}, {2.0, 0.5}});
  refused({{1, 0}, {1, 0}, {1, 0}, {1, 0}});
  refused({{0.2, -0.4}, {0.2, 0.4}, {2.0, -0.5}, {2.0, -0.5}});
}

TEST_CASE("The table fit refuses swapped corners and coordinates that are not finite") {
  std::vector<Correspondence> swapped = correspondences_of(test_camera(), kCorners);
  std::swap(swapped[0].table, swapped[1].table);
  CHECK_THROWS_AS(fit_homography(swapped), std::invalid_argument);
  std::vector<Correspondence> broken = correspondences_of(test_camera(), kCorners);
  broken[2].image.x = std::numeric_limits<double>::infinity();
  CHECK_THROWS_AS(fit_homography(broken), std::invalid_argument);
}

}  // namespace
}  // namespace puck
