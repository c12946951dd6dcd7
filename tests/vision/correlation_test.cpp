#include "common/vision/correlation/correlation.h"

#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <opencv2/imgproc.hpp>

#include "common/vision/correlation/gaussian_blur.h"
#include "common/vision/correlation/kernel_bank.h"
#include "tests/support/kernel_weights.h"
#include "tests/support/simd_targets.h"

namespace puck {
namespace {

Image<std::uint8_t> noise(int width, int height) {
  std::mt19937 random(5);
  Image<std::uint8_t> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image(x, y) = static_cast<std::uint8_t>(random() % 256);
  }
  return image;
}

Image<std::uint8_t> blurred(const Image<std::uint8_t>& surface) {
  GaussianBlur blur;
  Image<std::uint8_t> picture;
  blur.apply(surface.view(), picture);
  return picture;
}

// The kernel's response with its anchor on (x, y) of a blurred surface, pixel by pixel.
double dense_response(const Image<std::uint8_t>& picture, const Region& region,
                      const EllipseKernel& kernel, int x, int y) {
  const Image<double> weights = test::weights_of(kernel);
  double sum = 0;
  for (int j = 0; j < weights.height(); ++j) {
    for (int i = 0; i < weights.width(); ++i) {
      const int px = x - kernel.anchor_x() + i;
      const int py = y - kernel.anchor_y() + j;
      if (region.contains(px, py)) sum += weights(i, j) * picture(px - region.x, py - region.y);
    }
  }
  return sum;
}

}  // namespace

TEST_CASE("on every instruction set correlation equals the dense sum, even over the edge") {
  const Region region{100, 50, 40, 30};
  const Image<std::uint8_t> surface = noise(region.width, region.height);
  const Image<std::uint8_t> picture = blurred(surface);
  const KernelBank bank(KernelBankParams{});
  Correlation correlation;
  CorrelationMap map;
  for (const PuckSize size : {PuckSize{9, 9}, {15, 11}, {51, 45}}) {
    const EllipseKernel& kernel = bank.nearest(size);
    const Region candidates{90, 40, 60, 50};
    with_each_simd_target([&](const std::string& target) {
      CAPTURE(target);
      correlation.set_surface(surface.view(), region);
      correlation.correlate(kernel, candidates, map);
      for (int y = 0; y < candidates.height; y += 3) {
        for (int x = 0; x < candidates.width; x += 3) {
          REQUIRE(map.response(x, y) ==
                  doctest::Approx(
                      dense_response(picture, region, kernel, candidates.x + x, candidates.y + y)));
        }
      }
    });
  }
}

TEST_CASE("the bright parts of a row hold every place from which a kernel covers a bright pixel") {
  const Region region{100, 50, 200, 120};
  Image<std::uint8_t> picture(region.width, region.height);
  for (int y = 40; y < 60; ++y) {
    for (int x = 90; x < 120; ++x) picture(x, y) = 200;
  }
  const KernelBank bank(KernelBankParams{});
  const EllipseKernel& kernel = bank.nearest({21, 15});
  Correlation correlation;
  correlation.set_surface(picture.view(), region);
  int places = 0;
  for (int y = region.y; y < region.bottom(); ++y) {
    const Region row{region.x, y, region.width, 1};
    std::vector<bool> is_bright(static_cast<std::size_t>(row.width));
    int end = row.x;
    correlation.for_each_bright_part(kernel, row, [&](const Region& part) {
      REQUIRE(part.x >= end);
      REQUIRE(part.y == y);
      end = part.right();
      places += part.width;
      for (int x = part.x; x < part.right(); ++x) {
        is_bright[static_cast<std::size_t>(x - row.x)] = true;
      }
    });
    REQUIRE(end <= row.right());
    for (int x = row.x; x < row.right(); ++x) {
      double grey = 0;
      for (int py = y - kernel.anchor_y(); py < y - kernel.anchor_y() + kernel.height(); ++py) {
        for (int px = x - kernel.anchor_x(); px < x - kernel.anchor_x() + kernel.width(); ++px) {
          if (region.contains(px, py)) grey += picture(px - region.x, py - region.y);
        }
      }
      if (grey > 0) REQUIRE(is_bright[static_cast<std::size_t>(x - row.x)]);
    }
  }
  // The square and what a kernel reaches around it, but not the whole picture.
  CHECK(places > 30 * 20);
  CHECK(places < region.width * region.height / 3);
}

TEST_CASE("an earlier picture leaves no trace where the next one is dark") {
  const KernelBank bank(KernelBankParams{});
  const EllipseKernel& kernel = bank.nearest({15, 11});
  for (const Region& candidates : {Region{100, 50, 40, 30}, {100, 50, 100, 60}}) {
    const auto [left, top, width, height] = candidates;
    const Image<std::uint8_t> surface = noise(width, height);
    const Image<std::uint8_t> picture = blurred(surface);
    Correlation correlation;
    CorrelationMap map;
    // Dark parts: above and left of it; below and right; all but the lower end; all.
    for (const Region& region : {Region{left + 10, top + 10, width, height},
                                 {left - 10, top - 10, width, height},
                                 {left, top + height - 5, width, height},
                                 {left + 200, top, width, height}}) {
      CAPTURE(candidates.width);
      CAPTURE(region.x);
      correlation.set_surface(surface.view(), candidates);
      correlation.correlate(kernel, candidates, map);
      correlation.set_surface(surface.view(), region);
      correlation.correlate(kernel, candidates, map);
      for (int y = 0; y < candidates.height; ++y) {
        for (int x = 0; x < candidates.width; ++x) {
          REQUIRE(map.response(x, y) ==
                  doctest::Approx(
                      dense_response(picture, region, kernel, candidates.x + x, candidates.y + y)));
        }
      }
    }
  }
}

TEST_CASE("correlation equals OpenCV's filter2D where the kernel lies inside the picture") {
  const Region region{0, 0, 80, 60};
  const Image<std::uint8_t> surface = noise(region.width, region.height);
  Image<std::uint8_t> picture = blurred(surface);
  const KernelBank bank(KernelBankParams{});
  const EllipseKernel& kernel = bank.nearest({29, 19});
  Image<double> weights = test::weights_of(kernel);
  const cv::Mat input(60, 80, CV_8U, picture.row(0));
  const cv::Mat filter(weights.height(), weights.width(), CV_64F, weights.row(0));
  cv::Mat expected;
  cv::filter2D(input, expected, CV_64F, filter, {kernel.anchor_x(), kernel.anchor_y()}, 0,
               cv::BORDER_CONSTANT);

  Correlation correlation;
  correlation.set_surface(surface.view(), region);
  CorrelationMap map;
  correlation.correlate(kernel, region, map);
  for (int y = 0; y < 60; ++y) {
    for (int x = 0; x < 80; ++x) {
      REQUIRE(map.response(x, y) == doctest::Approx(expected.at<double>(y, x)).epsilon(1e-6));
    }
  }
}

TEST_CASE("the contrast at a pixel is that of the kernel's zones there") {
  const Region region{10, 20, 60, 60};
  Image<std::uint8_t> picture(60, 60);
  const KernelBank bank(KernelBankParams{});
  const EllipseKernel& kernel = bank.nearest({29, 19});
  // A full ring around (40, 50), and nothing else.
  const Image<double> weights = test::weights_of(kernel);
  for (int j = 0; j < weights.height(); ++j) {
    for (int i = 0; i < weights.width(); ++i) {
      picture(40 - 10 - kernel.anchor_x() + i, 50 - 20 - kernel.anchor_y() + j) =
          weights(i, j) > 1 ? 255 : 0;
    }
  }
  Correlation correlation;
  correlation.set_surface(picture.view(), region);
  CHECK(correlation.contrast_at(kernel, 40, 50) > 0.6);
  CHECK(correlation.contrast_at(kernel, 48, 50) < 0.4);
  CHECK(correlation.contrast_at(kernel, 1000, -1000) == 0);
}

TEST_CASE("an empty region of candidates gives an empty map") {
  Correlation correlation;
  const Image<std::uint8_t> picture = noise(10, 10);
  correlation.set_surface(picture.view(), {0, 0, 10, 10});
  CorrelationMap map;
  const KernelBank bank(KernelBankParams{});
  correlation.correlate(bank.nearest({9, 9}), {3, 3, 0, 4}, map);
  CHECK(map.region.empty());
}

}  // namespace puck
