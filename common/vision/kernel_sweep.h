#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/vision/ellipse_kernel.h"
#include "common/vision/region.h"
#include "common/vision/row_sums.h"
#include "common/vision/sweep_plan.h"

namespace puck {

/// Sums of a kernel's filled shapes at each of a rectangle of candidates. An ellipse is a run of
/// pixels in each of its rows, so a sum is made of two numbers a row, for as many candidates at
/// once as vectors hold. The sums are exact; every instruction set gives the same.
///
/// They are made in 16 bits, which is enough for what a sum changes by from one row of candidates
/// to the next: at most a pixel a column on a canvas of `kWidest` columns, 128 · 255 = 32640. So
/// the difference of two such sums is the true one, and the total, in 32 bits, follows from the
/// first row's, which is summed up in 16 bits for as many runs at once as fit, and then in 32. A
/// canvas's sum changes by its last row and by the one above its first.
class KernelSweep {
 public:
  static constexpr int kWidest = 128;

  /// The totals of a part of the candidates.
  struct Totals {
    Region region;         ///< Rows, and columns that were wanted at least.
    int first_column = 0;  ///< Of what `values` begins with.
    std::ptrdiff_t stride = 0;
    std::vector<std::int32_t> values;

    /// Makes room for whole vectors of candidates; the values are not set.
    void make_room(const Region& candidates, const Region& kept);

    const std::int32_t* row(int y) const {
      return values.data() + (y - region.y) * stride + (region.x - first_column);
    }
  };

  /// Whether the kernel can be swept; otherwise sum_plainly is there.
  static bool can_sweep(const EllipseKernel& kernel) { return kernel.width() <= kWidest; }

  /// The weighted total at each candidate; returns the lowest of them all, keeps those in `kept`,
  /// which lies inside the candidates. `picture` shows all that the kernel reaches from them.
  std::int32_t sweep(const RowSums& picture, const EllipseKernel& kernel,
                     EllipseKernel::WholeWeights weights, const Region& candidates,
                     const Region& kept, Totals& totals);

  /// The sums over the canvas, the outer and the inner ellipse, each on its own.
  void sweep(const RowSums& picture, const EllipseKernel& kernel, const Region& candidates,
             std::array<Totals, 3>& sums);

 private:
  // All but what the totals are made of and where they go. It borrows the runs below.
  SweepPlan plan_for(const RowSums& picture, const EllipseKernel& kernel, const Region& candidates,
                     const Region& kept);

  std::vector<SumRun> canvas_;
  std::vector<SumRun> outer_;
  std::vector<SumRun> inner_;
};

/// The sums over the canvas, the outer and the inner ellipse with the anchor on one pixel, for a
/// kernel that can be swept.
std::array<std::int32_t, 3> sums_at(const RowSums& picture, const EllipseKernel& kernel, int x,
                                    int y);

}  // namespace puck
