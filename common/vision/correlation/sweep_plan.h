#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "common/vision/correlation/ellipse_kernel.h"

namespace puck {

/// A run of pixels as the two sums whose difference it is, as they lie from a canvas's first one.
struct SumRun {
  std::ptrdiff_t high = 0;
  std::ptrdiff_t low = 0;
};

/// What KernelSweep hands to the code that is compiled for each instruction set.
struct SweepPlan {
  const std::uint16_t* first = nullptr;  ///< Of the sums, at the first candidate's canvas.
  std::ptrdiff_t stride = 0;             ///< Of the sums.
  std::size_t width = 0;                 ///< Candidates in a row.
  int rows = 0;                          ///< Rows of candidates.
  std::size_t runs_at_once = 1;          ///< So many have a sum of 16 bits.
  std::span<const SumRun> canvas;
  std::span<const SumRun> outer;
  std::span<const SumRun> inner;
  EllipseKernel::WholeWeights weights;  ///< Unless the sums are separate.
  bool separate = false;
  int kept_first = 0;  ///< Rows of candidates whose totals are written to `out`.
  int kept_last = 0;
  std::array<std::int32_t*, 3> out{};
  std::ptrdiff_t out_stride = 0;
};

}  // namespace puck
