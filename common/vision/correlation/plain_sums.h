#pragma once

#include <array>

#include "common/vision/correlation/ellipse_kernel.h"
#include "common/vision/correlation/kernel_sweep.h"
#include "common/vision/correlation/row_sums.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// The specification of KernelSweep: the same sums over the canvas, the outer and the inner
/// ellipse, pixel by pixel.
void sum_plainly(const RowSums& picture, const EllipseKernel& kernel, const Region& candidates,
                 std::array<KernelSweep::Totals, 3>& sums);

}  // namespace puck
