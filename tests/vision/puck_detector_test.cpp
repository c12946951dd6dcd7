#include "common/vision/paper/puck_detector.h"

#include <cmath>

#include <doctest/doctest.h>

#include "common/vision/paper/paper_presets.h"
#include "common/vision/presets.h"
#include "tests/vision/test_sensor.h"

namespace puck {
namespace {

using test::kImage;
using test::kSensor;

// Draws a kernel's ring, fully lit, around a pixel.
void draw_ring(Image<std::uint8_t>& picture, const EllipseKernel& kernel, int x, int y) {
  const int top = y - kernel.anchor_y();
  const int left = x - kernel.anchor_x();
  for (int row = 0; row < kernel.height(); ++row) {
    const auto outer = kernel.outer_run(row);
    const auto inner = kernel.inner_run(row);
    for (int column = outer.first; column < outer.last; ++column) {
      if (column >= inner.first && column < inner.last) continue;
      picture(left + column, top + row) = 255;
    }
  }
}

}  // namespace

TEST_CASE("the fixed detection kernel has the zones of the authors' code and their threshold") {
  const PuckPipelineParams params = reference_params();
  const KernelBank bank(params.kernels);
  PuckDetector detector(params.detector, authors_static_size_model());
  // A fully lit annulus of 172 pixels gives the largest response, if it were not blurred: 43,860.
  const EllipseKernel ring({30, 19, 15.2, 9.5, 15.2, 9.5, 15, 9}, params.detector.fixed_profile);
  CHECK(ring.ring_pixels() == 172);
  CHECK(ring.inside_pixels() == 270);
  CHECK(ring.outside_pixels() == 128);
  CHECK(ring.response(255 * 172, 255 * 172, 0) == doctest::Approx(43'860));
  Image<std::uint8_t> picture(640, 480);
  draw_ring(picture, ring, 300, 190);
  Correlation correlation;
  correlation.set_surface(picture.view(), kImage);
  const Region region = detection_region(kSensor, params.detector);
  const auto& found = detector.detect(correlation, region, bank);
  REQUIRE(found.size() == 1);
  CHECK(found.front().position == Pixel{300, 190});
  CHECK(found.front().response > 20'000);
  CHECK(found.front().response < 43'860);
}

TEST_CASE("a response up to the threshold is no detection") {
  PuckPipelineParams params = reference_params();
  const KernelBank bank(params.kernels);
  Image<std::uint8_t> picture(640, 480);
  for (int x = 296; x < 308; ++x) picture(x, 190) = 250;  // 12 pixels: 3000 at the very best
  Correlation correlation;
  correlation.set_surface(picture.view(), kImage);
  PuckDetector detector(params.detector, authors_static_size_model());
  CHECK(detector.detect(correlation, detection_region(kSensor, params.detector), bank).empty());
  params.detector.threshold = 100;
  PuckDetector eager(params.detector, authors_static_size_model());
  CHECK(eager.detect(correlation, detection_region(kSensor, params.detector), bank).size() == 1);
}

TEST_CASE("a search with the size of each row finds the puck near and far") {
  const PuckPipelineParams params = correlation_params();
  const KernelBank bank(params.kernels);
  const PuckSizeModel model{17, 0, 0.09, 8, 0, 0.09};
  for (const Pixel truth : {Pixel{101, 31}, {320, 190}, {500, 401}}) {
    Image<std::uint8_t> picture(640, 480);
    draw_ring(picture, bank.nearest(model.at(truth)), static_cast<int>(truth.x),
              static_cast<int>(truth.y));
    Correlation correlation;
    correlation.set_surface(picture.view(), kImage);
    PuckDetector detector(params.detector, model);
    CHECK(detection_region(kSensor, params.detector) == kImage);
    const Region region = detection_region(kSensor, params.detector);
    const auto& found = detector.detect(correlation, region, bank);
    REQUIRE_FALSE(found.empty());
    CHECK(found.front().position == truth);
  }
}

TEST_CASE("a search finds every puck, best first, and no place twice") {
  const PuckPipelineParams params = correlation_params();
  const KernelBank bank(params.kernels);
  const PuckSizeModel model{25, 0, 0, 17, 0, 0};
  const EllipseKernel& ring = bank.nearest(model.at({}));
  Image<std::uint8_t> picture(640, 480);
  draw_ring(picture, ring, 100, 100);
  draw_ring(picture, ring, 400, 301);
  draw_ring(picture, ring, 200, 51);
  for (int x = 395; x <= 405; ++x) picture(x, 301) = 255;  // less of a ring
  for (int x = 180; x <= 220; x += 2) picture(x, 40) = 0;  // even less
  for (int x = 180; x <= 220; ++x) picture(x, 51) = 255;
  Correlation correlation;
  correlation.set_surface(picture.view(), kImage);
  PuckDetector detector(params.detector, model);
  const auto& found = detector.detect(correlation, kImage, bank);
  REQUIRE(found.size() >= 3);
  CHECK(found.size() <= PuckDetector::kMostDetections);
  CHECK(found[0].position == Pixel{100, 100});
  CHECK(found[1].position == Pixel{400, 301});
  CHECK(found[2].position == Pixel{200, 51});
  for (std::size_t i = 0; i < found.size(); ++i) {
    CHECK(found[i].response > params.detector.threshold);
    for (std::size_t j = 0; j < i; ++j) {
      CHECK(found[j].response >= found[i].response);
      const double dx = std::abs(found[j].position.x - found[i].position.x);
      const double dy = std::abs(found[j].position.y - found[i].position.y);
      // Refining moves a place by a pixel at most.
      CHECK((dx > 25 / 2 - 2 || dy > 17 / 2 - 2));
    }
  }
}

TEST_CASE("an empty region gives no detection") {
  const PuckPipelineParams params = correlation_params();
  const KernelBank bank(params.kernels);
  PuckDetector detector(params.detector, authors_static_size_model());
  Correlation correlation;
  CHECK(detector.detect(correlation, {}, bank).empty());
}

}  // namespace puck
