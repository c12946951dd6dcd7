#include "common/vision/correlation/block_sums.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "common/vision/correlation/correlation.h"
#include "common/vision/correlation/kernel_bank.h"
#include "common/vision/presets.h"
#include "tests/support/simd_targets.h"
#include "tests/vision/noise_picture.h"

namespace puck {
namespace {

std::int64_t brightest_rectangle(const Image<std::uint8_t>& picture, int width, int height) {
  std::int64_t most = 0;
  for (int y = 1 - height; y < picture.height(); ++y) {
    for (int x = 1 - width; x < picture.width(); ++x) {
      std::int64_t sum = 0;
      for (int j = std::max(y, 0); j < std::min(y + height, picture.height()); ++j) {
        for (int i = std::max(x, 0); i < std::min(x + width, picture.width()); ++i) {
          sum += picture(i, j);
        }
      }
      most = std::max(most, sum);
    }
  }
  return most;
}

// The lowest response of all candidates with the kernel touching the picture.
double lowest_response(Correlation& correlation, const EllipseKernel& kernel, const Region& place) {
  const Region candidates = place.inflated(std::max(kernel.width(), kernel.height()));
  CorrelationMap map;
  return correlation.correlate_lowest(kernel, candidates, candidates, map);
}

}  // namespace

TEST_CASE("on every instruction set no rectangle is brighter than the blocks that it touches") {
  with_each_simd_target([&](const std::string& target) {
    CAPTURE(target);
    unsigned seed = 1;
    for (const int width : {1, 7, 8, 9, 41, 130}) {
      for (const int height : {1, 8, 30}) {
        const Image<std::uint8_t> picture = test::noise(width, height, seed++);
        BlockSums blocks;
        blocks.set_picture(picture.view());
        CHECK(blocks.most_in(1000, 1000) == brightest_rectangle(picture, width, height));
        for (const int side : {1, 2, 9, 10}) {
          const std::int64_t brightest = brightest_rectangle(picture, side, side + 3);
          CHECK(blocks.most_in(side, side + 3) >= brightest);
        }
      }
    }
  });
}

TEST_CASE("a rectangle's bound counts only blocks that it can touch") {
  Image<std::uint8_t> white(64, 64);
  std::fill_n(white.row(0), 64 * 64, std::uint8_t{255});
  BlockSums blocks;
  blocks.set_picture(white.view());
  CHECK(blocks.most_in(1, 1) == 8 * 8 * 255);
  CHECK(blocks.most_in(2, 1) == 16 * 8 * 255);
  CHECK(blocks.most_in(9, 1) == 16 * 8 * 255);
  CHECK(blocks.most_in(10, 9) == 24 * 16 * 255);
}

TEST_CASE("no response is below the blocks' bound") {
  for (const Preset preset : {Preset::kReference, Preset::kPaper}) {
    const KernelBank bank(search_params(preset_params(preset)).kernels);
    for (const PuckSize size : {PuckSize{9, 9}, {21, 13}, {45, 39}}) {
      const EllipseKernel& kernel = bank.nearest(size);
      for (const int side : {5, 9, 30, 70}) {
        const Region place{-10, 20, side, side + side / 3};
        // Dim pictures, which rounding brightens; a white one; a single bright edge, which the blur
        // mirrors; a disc of the inner ellipse's size.
        for (const int kind : {0, 1, 2, 3}) {
          Image<std::uint8_t> picture = test::noise(place.width, place.height, 7);
          for (int y = 0; y < place.height; ++y) {
            for (int x = 0; x < place.width; ++x) {
              std::uint8_t& grey = picture(x, y);
              if (kind == 0) grey = grey % 2;
              if (kind == 1) grey = 255;
              if (kind == 2) grey = y == 1 || x == 1 ? 255 : 0;
              if (kind == 3) {
                const double u = (x - place.width / 2) / (0.5 * kernel.inner_width());
                const double v = (y - place.height / 2) / (0.5 * kernel.inner_height());
                grey = u * u + v * v <= 1 ? 255 : 0;
              }
            }
          }
          CAPTURE(side);
          CAPTURE(kind);
          Correlation correlation;
          correlation.set_surface(picture.view(), place);
          CHECK(correlation.lower_bound(kernel) <= lowest_response(correlation, kernel, place));
        }
      }
    }
  }
}

}  // namespace puck
