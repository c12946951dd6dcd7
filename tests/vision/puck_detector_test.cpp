#include "common/vision/puck_detector.h"

#include <doctest/doctest.h>

#include "common/vision/presets.h"

namespace puck {
namespace {

constexpr SensorSize kSensor{640, 480};
constexpr Region kImage{0, 0, 640, 480};

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
  const PipelineParams params = preset_params(Preset::kReference);
  const KernelBank bank(params.kernels);
  PuckDetector detector(kSensor, params.detector, authors_static_size_model());
  // A fully lit annulus of 172 pixels is the best that there can be: 43,860.
  const EllipseKernel ring({30, 19, 15.2, 9.5, 15.2, 9.5, 15, 9}, params.detector.fixed_profile);
  CHECK(ring.ring_pixels() == 172);
  CHECK(ring.inside_pixels() == 270);
  CHECK(ring.outside_pixels() == 128);
  Image<std::uint8_t> picture(640, 480);
  draw_ring(picture, ring, 300, 190);
  Correlation correlation;
  correlation.set_picture(picture.view(), kImage);
  const auto found = detector.detect(correlation, detector.region(), bank);
  REQUIRE(found.has_value());
  CHECK(found->position == Pixel{300, 190});
  CHECK(found->response == doctest::Approx(43'860));
}

TEST_CASE("what does not exceed the threshold is not detected") {
  PipelineParams params = preset_params(Preset::kReference);
  const KernelBank bank(params.kernels);
  Image<std::uint8_t> picture(640, 480);
  for (int x = 296; x < 308; ++x) picture(x, 190) = 250;  // 12 pixels: 3000 at the very best
  Correlation correlation;
  correlation.set_picture(picture.view(), kImage);
  PuckDetector detector(kSensor, params.detector, authors_static_size_model());
  CHECK_FALSE(detector.detect(correlation, detector.region(), bank).has_value());
  params.detector.threshold = 100;
  PuckDetector eager(kSensor, params.detector, authors_static_size_model());
  CHECK(eager.detect(correlation, eager.region(), bank).has_value());
}

TEST_CASE("a search with the size of each row finds the puck near and far") {
  const PipelineParams params = preset_params(Preset::kDefault);
  const KernelBank bank(params.kernels);
  const PuckSizeModel model{17, 0, 0.09, 8, 0, 0.09};
  for (const Pixel truth : {Pixel{101, 31}, {320, 190}, {500, 401}}) {
    Image<std::uint8_t> picture(640, 480);
    draw_ring(picture, bank.nearest(model.at(truth)), static_cast<int>(truth.x),
              static_cast<int>(truth.y));
    Correlation correlation;
    correlation.set_picture(picture.view(), kImage);
    PuckDetector detector(kSensor, params.detector, model);
    CHECK(detector.region() == kImage);
    const auto found = detector.detect(correlation, detector.region(), bank);
    REQUIRE(found.has_value());
    CHECK(found->position == truth);
  }
}

TEST_CASE("nothing is detected in an empty region") {
  const PipelineParams params = preset_params(Preset::kDefault);
  const KernelBank bank(params.kernels);
  PuckDetector detector(kSensor, params.detector, authors_static_size_model());
  Correlation correlation;
  CHECK_FALSE(detector.detect(correlation, {}, bank).has_value());
}

}  // namespace puck
