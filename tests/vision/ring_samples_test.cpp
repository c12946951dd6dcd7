#include "common/vision/contour/ring_samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

namespace puck {
namespace {

Image<std::uint8_t> grey(int width, int height, std::uint8_t value) {
  Image<std::uint8_t> picture(width, height);
  for (int y = 0; y < height; ++y) std::fill_n(picture.row(y), width, value);
  return picture;
}

}  // namespace

TEST_CASE("a ring's samples are the pixels within reach of it, the rest of it is its inside") {
  const Image<std::uint8_t> picture = grey(100, 100, 10);
  RingSamples samples;
  samples.gather(picture.view(), {200, 100, 100, 100}, {15, 10, 0, 0}, {250, 150});
  // Ellipses of 19×14 and 11×6 px half axes.
  const double outer = std::numbers::pi * 19 * 14;
  const double inner = std::numbers::pi * 11 * 6;
  CHECK(samples.inside_pixels() == doctest::Approx(inner).epsilon(0.05));
  CHECK(samples.inside_sum() == 10.0 * samples.inside_pixels());
  CHECK(static_cast<double>(samples.near().size()) == doctest::Approx(outer - inner).epsilon(0.05));
  for (const RingSample& sample : samples.near()) {
    REQUIRE(std::abs(sample.distance_px) < RingSamples::kReachPx + 1);
    REQUIRE(std::hypot(sample.normal_x, sample.normal_y) == doctest::Approx(1).epsilon(1e-3));
  }
}

TEST_CASE("a ring's bright samples are all that are not dark") {
  Image<std::uint8_t> picture = grey(100, 100, 0);
  for (int y = 0; y < 100; ++y) std::fill_n(picture.row(y), 50, std::uint8_t{9});
  RingSamples samples;
  samples.gather(picture.view(), {0, 0, 100, 100}, {15, 10, 0, 0}, {49.5, 50});
  CHECK(2 * samples.bright().size() == samples.near().size());
  for (const RingSample& sample : samples.bright()) REQUIRE(sample.grey == 9);
}

TEST_CASE("what lies outside the picture is no sample") {
  const Image<std::uint8_t> picture = grey(100, 100, 10);
  RingSamples all;
  all.gather(picture.view(), {0, 0, 100, 100}, {15, 10, 0, 0}, {50, 50});
  RingSamples half;
  half.gather(picture.view(), {0, 0, 100, 100}, {15, 10, 0, 0}, {-0.5, 50});
  CHECK(static_cast<double>(half.near().size()) ==
        doctest::Approx(static_cast<double>(all.near().size()) / 2).epsilon(0.05));
  RingSamples none;
  none.gather(picture.view(), {0, 0, 100, 100}, {15, 10, 0, 0}, {1000, 50});
  CHECK(none.near().empty());
}

TEST_CASE("a ring that a size model without sense makes has no samples") {
  const Image<std::uint8_t> picture = grey(20, 20, 10);
  RingSamples samples;
  for (const double semi : {1e12, std::nan("")}) {
    samples.gather(picture.view(), {0, 0, 20, 20}, {semi, semi, 0, 0}, {10, 10});
    CHECK(samples.near().empty());
    CHECK(samples.inside_pixels() == 0);
  }
}

}  // namespace puck
