#include "common/calibration/camera_fit.h"

#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/calibration/homography_fit.h"
#include "common/table/table_camera.h"
#include "tests/support/test_camera.h"

namespace puck {
namespace {

constexpr Pixel kMiddle{320, 240};

std::vector<Correspondence> grid_seen_by(const Homography& camera) {
  std::vector<Correspondence> correspondences;
  for (double x = 0.2; x < 2.1; x += 0.45) {
    for (double y = -0.5; y < 0.6; y += 0.25) {
      correspondences.push_back({*camera.to_image({x, y}), {x, y}});
    }
  }
  return correspondences;
}

FocalLengthFit fit_to(const std::vector<Correspondence>& correspondences) {
  return fit_focal_length(fit_homography(correspondences).homography, kMiddle, correspondences);
}

TEST_CASE("The focal length follows from the foreshortening of the table's depth") {
  const FocalLengthFit fit = fit_to(grid_seen_by(test_camera()));
  CHECK(fit.focal_px == doctest::Approx(700));
  CHECK(fit.rms_px < 1e-6);
}

TEST_CASE("The focal length of a camera beside the table's middle is found as well") {
  const TableCamera camera(test_camera(), {700, kMiddle, {}});
  const Homography aside = camera.view_at({8, -2, 5, 0, 0, 0})->homography();
  CHECK(fit_to(grid_seen_by(aside)).focal_px == doctest::Approx(700));
}

TEST_CASE("Marking errors change the focal length by as much as the fit's standard error") {
  const std::vector<Correspondence> exact = grid_seen_by(test_camera());
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, 0.5);
  double sum = 0;
  double said = 0;
  constexpr int kTrials = 40;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<Correspondence> marked = exact;
    for (Correspondence& c : marked) {
      c.image = {c.image.x + noise(random), c.image.y + noise(random)};
    }
    const FocalLengthFit fit = fit_to(marked);
    sum += (fit.focal_px / 700 - 1) * (fit.focal_px / 700 - 1);
    said = fit.sigma_per_px;
    CHECK(fit.rms_px > 0.3);
    CHECK(fit.rms_px < 1.0);
  }
  CHECK(std::sqrt(sum / kTrials) == doctest::Approx(0.5 * said).epsilon(0.3));
}

TEST_CASE("A camera that looks straight down does not determine its focal length") {
  // 0.004 m a pixel, x of the table upwards.
  const Homography above({0, -0.004, 2, -0.004, 0, 1.28, 0, 0, 1});
  std::string refusal;
  try {
    fit_to(grid_seen_by(above));
  } catch (const std::invalid_argument& error) {
    refusal = error.what();
  }
  CHECK(refusal.find("do not fix the focal length") != std::string::npos);
}

TEST_CASE("Places close together do not determine the focal length") {
  std::vector<Correspondence> close;
  for (const TablePoint point : {TablePoint{1, 0}, {1, 0.05}, {1.05, 0}, {1.05, 0.05}}) {
    close.push_back({*test_camera().to_image(point), point});
  }
  CHECK_THROWS_AS(fit_to(close), std::invalid_argument);
}

}  // namespace
}  // namespace puck
