#include "common/vision/correlation/ellipse_kernel.h"

#include <stdexcept>

#include <doctest/doctest.h>

#include "common/vision/correlation/kernel_bank.h"
#include "tests/support/kernel_weights.h"

namespace puck {
namespace {

// The zones of the authors' tracking kernels, counted from the constants of their code.
struct Zones {
  PuckSize size;
  int inside;
  int ring;
  int outside;
};

double sum_of(const Image<double>& picture) {
  double sum = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) sum += picture(x, y);
  }
  return sum;
}

}  // namespace

TEST_CASE("the reference kernels have as many pixels in each zone as the authors' code") {
  const KernelBank bank(KernelBankParams{});
  for (const Zones& zones : {Zones{{29, 19}, 159, 158, 442}, Zones{{37, 25}, 269, 272, 648},
                             Zones{{51, 45}, 685, 698, 1312}}) {
    CAPTURE(zones.size.width);
    const EllipseKernel& kernel = bank.nearest(zones.size);
    CHECK(kernel.width() == zones.size.width + 4);
    CHECK(kernel.height() == zones.size.height + 4);
    CHECK(kernel.inside_pixels() == zones.inside);
    CHECK(kernel.ring_pixels() == zones.ring);
    CHECK(kernel.outside_pixels() == zones.outside);
  }
  CHECK(sum_of(test::weights_of(bank.nearest({29, 19}))) == doctest::Approx(226.6));
  CHECK(sum_of(test::weights_of(bank.nearest({37, 25}))) == doctest::Approx(417.4));
  CHECK(sum_of(test::weights_of(bank.nearest({51, 45}))) == doctest::Approx(1146.6));
}

TEST_CASE("a kernel's weights are those of its profile in each zone") {
  const EllipseKernel kernel({21, 21, 10, 10, 10, 10, 10, 10},
                             {0.4, 0.8, -1, 3, -0.2, KernelMeasure::kWeightedSum});
  const Image<double> weights = test::weights_of(kernel);
  CHECK(weights(10, 10) == doctest::Approx(-1));
  CHECK(weights(18, 10) == doctest::Approx(3));  // squared normalised radius 0.64
  CHECK(weights(20, 10) == doctest::Approx(-0.2));
  CHECK(weights(0, 0) == doctest::Approx(-0.2));
}

TEST_CASE("contrast is zero on an even picture and nearly one on a perfect ring, at every size") {
  const KernelBank bank(KernelBankParams{});
  for (const PuckSize size : {PuckSize{9, 9}, {29, 19}, {51, 45}}) {
    const EllipseKernel& kernel = bank.nearest(size);
    const double ring = 255.0 * kernel.ring_pixels();
    const double inside = 255.0 * kernel.inside_pixels();
    const double outside = 255.0 * kernel.outside_pixels();
    CHECK(kernel.contrast(ring, ring, 0) == doctest::Approx(1 / 1.05));
    CHECK(kernel.contrast(ring + inside + outside, ring + inside, inside) == doctest::Approx(0));
    CHECK(kernel.contrast(inside + outside, inside, inside) == 0);
  }
}

TEST_CASE("contrast does not grow with a few stray events on the ring") {
  const EllipseKernel kernel({25, 19, 12, 9, 9.5, 6.5, 12, 9}, {});
  CHECK(kernel.contrast(255, 255, 0) < 0.25);
}

TEST_CASE("a kernel's response is its profile's measure") {
  KernelProfile profile;
  const KernelGeometry geometry{25, 19, 12, 9, 9.5, 6.5, 12, 9};
  const EllipseKernel sum(geometry, profile);
  CHECK(sum.response(300, 200, 100) == doctest::Approx(-1 * 100 + 3 * 100 - 0.2 * 100));
  profile.measure = KernelMeasure::kContrast;
  const EllipseKernel contrast(geometry, profile);
  CHECK(contrast.response(300, 200, 0) == contrast.contrast(300, 200, 0));
}

TEST_CASE("an empty canvas, one that is too wide, or an empty ellipse is refused") {
  CHECK_THROWS_AS(EllipseKernel({0, 5, 0, 0, 1, 1, 0, 0}, {}), std::invalid_argument);
  CHECK_THROWS_WITH_AS(EllipseKernel({129, 5, 64, 2, 64, 2, 64, 2}, {}),
                       "a kernel may be 128 px wide at most, got 129", std::invalid_argument);
  CHECK_THROWS_AS(EllipseKernel({5, 5, 2, 2, 0, 1, 2, 2}, {}), std::invalid_argument);
}

}  // namespace puck
