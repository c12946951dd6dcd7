#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "common/vision/correlation/ellipse_kernel.h"
#include "common/vision/correlation/row_sums.h"
#include "common/vision/geometry/region.h"

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

/// Sums of a kernel's filled shapes at each candidate in a rectangle. An ellipse is a run of pixels
/// in each of its rows, so a sum takes two numbers a row, for a vector of candidates at once. The
/// sums are exact; every instruction set gives the same.
///
/// The change of a sum from one row of candidates to the next fits into 16 bits: at most a pixel a
/// column on the widest canvas, 128 · 255 = 32640. So the difference of two 16-bit sums is exact
/// and is added to the total in 32 bits. The first row's sum is added up in 16 bits for as many
/// runs as fit, then in 32. A canvas's sum changes by its last row and the one above its first.
class KernelSweep {
 public:
  /// The totals of a part of the candidates.
  struct Totals {
    Region region;         ///< The rows, and at least the requested columns.
    int first_column = 0;  ///< Column of the first of `values`.
    std::ptrdiff_t stride = 0;
    std::vector<std::int32_t> values;

    /// Makes room for whole vectors of candidates; the values stay unset.
    void make_room(const Region& candidates, const Region& kept);

    const std::int32_t* row(int y) const {
      return values.data() + (y - region.y) * stride + (region.x - first_column);
    }
  };

  /// Returns the lowest weighted total of all candidates, and keeps the totals in `kept`, which
  /// lies inside the candidates. `picture` covers the kernel's reach from all candidates.
  std::int32_t sweep(const RowSums& picture, const EllipseKernel& kernel,
                     EllipseKernel::WholeWeights weights, const Region& candidates,
                     const Region& kept, Totals& totals);

  /// The sums over the canvas, the outer and the inner ellipse separately.
  void sweep(const RowSums& picture, const EllipseKernel& kernel, const Region& candidates,
             std::array<Totals, 3>& sums);

 private:
  // Everything but weights and destination of the totals. The plan borrows the runs below.
  SweepPlan plan_for(const RowSums& picture, const EllipseKernel& kernel, const Region& candidates,
                     const Region& kept);

  std::vector<SumRun> canvas_;
  std::vector<SumRun> outer_;
  std::vector<SumRun> inner_;
};

}  // namespace puck
