#pragma once

#include "common/vision/correlation/ellipse_kernel.h"
#include "common/vision/geometry/image.h"

namespace puck::test {

/// A kernel as a picture of its weights.
inline Image<double> weights_of(const EllipseKernel& kernel) {
  Image<double> picture(kernel.width(), kernel.height());
  for (int y = 0; y < kernel.height(); ++y) {
    const EllipseKernel::Run outer = kernel.outer_run(y);
    const EllipseKernel::Run inner = kernel.inner_run(y);
    for (int x = 0; x < kernel.width(); ++x) {
      const bool in_outer = x >= outer.first && x < outer.last;
      const bool in_inner = x >= inner.first && x < inner.last;
      picture(x, y) = kernel.weighted_sum(1, in_outer ? 1 : 0, in_inner ? 1 : 0);
    }
  }
  return picture;
}

}  // namespace puck::test
