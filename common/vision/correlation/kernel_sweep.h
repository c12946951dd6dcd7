#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/vision/correlation/ellipse_kernel.h"
#include "common/vision/correlation/row_sums.h"
#include "common/vision/correlation/sweep_plan.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// Sums of a kernel's filled shapes at each candidate in a rectangle. An ellipse is a run of pixels
/// in each of its rows, so a sum takes two numbers a row, for a vector of candidates at once. The
/// sums are exact; every instruction set gives the same.
///
/// The change of a sum from one row of candidates to the next fits into 16 bits: at most a pixel a
/// column on the widest canvas, 128 · 255 = 32640. So the difference of two 16-bit sums
/// is exact and is added to the total in 32 bits. The first row's sum is added up in 16 bits for as
/// many runs as fit, then in 32. A canvas's sum changes by its last row and the one above its
/// first.
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
