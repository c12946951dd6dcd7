#include "common/vision/correlation/kernel_sweep.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "common/vision/correlation/kernel_bank.h"
#include "common/vision/paper/paper_presets.h"
#include "common/vision/presets.h"
#include "tests/support/sanitizers.h"
#include "tests/support/simd_targets.h"
#include "tests/vision/noise_picture.h"

namespace puck {
namespace {

void show(RowSums& sums_of_rows, const Image<std::uint8_t>& picture) {
  sums_of_rows.resize({0, 0, picture.width(), picture.height()});
  const ImageView<std::uint8_t> pixels = sums_of_rows.pixels();
  for (int y = 0; y < picture.height(); ++y) {
    std::copy_n(picture.row(y), picture.width(), pixels.row(y));
  }
  sums_of_rows.sum_up(0, picture.height());
}

// All candidates for which the kernel lies inside the picture.
Region candidates_in(const Image<std::uint8_t>& picture, const EllipseKernel& kernel) {
  return {kernel.anchor_x(), kernel.anchor_y(), picture.width() - kernel.width() + 1,
          picture.height() - kernel.height() + 1};
}

// The specification of KernelSweep: the same sums over the canvas, the outer and the inner ellipse,
// pixel by pixel.
void sum_plainly(const RowSums& picture, const EllipseKernel& kernel, const Region& candidates,
                 std::array<KernelSweep::Totals, 3>& sums) {
  for (KernelSweep::Totals& totals : sums) totals.make_room(candidates, candidates);
  const int left = candidates.x - kernel.anchor_x() - picture.place().x;
  const int top = candidates.y - kernel.anchor_y() - picture.place().y;
  for (int y = 0; y < candidates.height; ++y) {
    for (int x = 0; x < candidates.width; ++x) {
      std::array<std::int32_t, 3> at{};
      for (int row = 0; row < kernel.height(); ++row) {
        const std::uint8_t* pixels = picture.picture().row(top + y + row) + left + x;
        const auto add = [&](std::size_t shape, int first, int last) {
          for (int column = first; column < last; ++column) at[shape] += pixels[column];
        };
        add(0, 0, kernel.width());
        add(1, kernel.outer_run(row).first, kernel.outer_run(row).last);
        add(2, kernel.inner_run(row).first, kernel.inner_run(row).last);
      }
      for (std::size_t i = 0; i < sums.size(); ++i) {
        sums[i].values[static_cast<std::size_t>(y * sums[i].stride + x)] = at[i];
      }
    }
  }
}

// The correct sums of a kernel over a picture, for every instruction set.
struct PlainSums {
  PlainSums(const Image<std::uint8_t>& picture, const EllipseKernel& of)
      : kernel(of), candidates(candidates_in(picture, of)) {
    show(sums_of_rows, picture);
    sum_plainly(sums_of_rows, kernel, candidates, shapes);
  }

  const EllipseKernel& kernel;
  Region candidates;
  RowSums sums_of_rows;
  std::array<KernelSweep::Totals, 3> shapes;
};

void check_sums(const PlainSums& expected) {
  const Region& candidates = expected.candidates;
  KernelSweep sweep;
  std::array<KernelSweep::Totals, 3> sums;
  sweep.sweep(expected.sums_of_rows, expected.kernel, candidates, sums);
  for (std::size_t shape = 0; shape < 3; ++shape) {
    for (int y = candidates.y; y < candidates.bottom(); ++y) {
      const bool same = std::equal(sums[shape].row(y), sums[shape].row(y) + candidates.width,
                                   expected.shapes[shape].row(y));
      REQUIRE(same);
    }
  }
  if (!expected.kernel.whole_weights()) return;
  const EllipseKernel::WholeWeights w = *expected.kernel.whole_weights();
  const Region kept = candidates.inflated(-1).intersect(candidates);
  KernelSweep::Totals totals;
  const std::int32_t lowest =
      sweep.sweep(expected.sums_of_rows, expected.kernel, w, candidates, kept, totals);
  std::int32_t expected_lowest = std::numeric_limits<std::int32_t>::max();
  for (int y = candidates.y; y < candidates.bottom(); ++y) {
    for (int x = 0; x < candidates.width; ++x) {
      const std::int32_t total = w.canvas * expected.shapes[0].row(y)[x] +
                                 w.outer * expected.shapes[1].row(y)[x] +
                                 w.inner * expected.shapes[2].row(y)[x];
      expected_lowest = std::min(expected_lowest, total);
      if (kept.contains(candidates.x + x, y)) {
        REQUIRE(totals.row(y)[x - (kept.x - candidates.x)] == total);
      }
    }
  }
  CHECK(lowest == expected_lowest);
}

}  // namespace

TEST_CASE("on every instruction set the sums over a kernel's shapes equal those pixel by pixel") {
  std::vector<KernelBank> banks;
  for (const Preset preset : {Preset::kReference, Preset::kPaper, Preset::kCorrelation}) {
    banks.emplace_back(search_params(preset_params(preset)).kernels);
  }
  std::vector<PlainSums> expected;
  unsigned seed = 1;
  for (const KernelBank& bank : banks) {
    for (const PuckSize size : {PuckSize{7, 7}, {15, 7}, {29, 19}, {39, 35}}) {
      const EllipseKernel& kernel = bank.nearest(size);
      for (const int more : {0, 1, 5, 66}) {
        expected.emplace_back(
            test::noise(kernel.width() + more, kernel.height() + more / 2, seed++), kernel);
      }
    }
  }
  with_each_simd_target([&](const std::string& target) {
    CAPTURE(target);
    for (const PlainSums& sums : expected) check_sums(sums);
  });
}

TEST_CASE("on every instruction set a white picture with the largest kernels does not overflow") {
  const KernelBank bank(correlation_params().kernels);
  const EllipseKernel& largest = bank.nearest({1e9, 1e9});
  REQUIRE(largest.width() == 91);
  KernelProfile profile;
  const EllipseKernel widest({128, 90, 64, 45, 63.5, 44.5, 64, 45}, profile);
  // A few rows of candidates for the highest kernel suffice under sanitizers.
  constexpr int kHeight = kIsSanitized ? 94 : 110;
  Image<std::uint8_t> white(200, kHeight);
  std::fill_n(white.row(0), 200 * kHeight, std::uint8_t{255});
  // The lower half dark: every edge pixel changes by the largest amount.
  Image<std::uint8_t> half = white;
  std::fill_n(half.row(kHeight / 2), 200 * kHeight / 2, std::uint8_t{0});
  std::vector<PlainSums> expected;
  for (const EllipseKernel* kernel : {&largest, &widest}) {
    expected.emplace_back(white, *kernel);
    expected.emplace_back(half, *kernel);
  }
  with_each_simd_target([&](const std::string& target) {
    CAPTURE(target);
    for (const PlainSums& sums : expected) check_sums(sums);
  });
}

}  // namespace puck
