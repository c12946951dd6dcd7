#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "common/vision/geometry/annotation.h"

namespace puck {

/// Residuals of fitted to annotated sizes, px.
struct SizeResiduals {
  double rms_px = 0;
  double max_px = 0;
};

/// Residuals of `size_at(centre)` in the direction `side`.
template <typename SizeAt>
SizeResiduals residuals_of(std::span<const Annotation> annotations, double PuckSize::*side,
                           const SizeAt& size_at) {
  SizeResiduals residuals;
  double sum = 0;
  for (const Annotation& annotation : annotations) {
    const double error = std::abs(annotation.size.*side - size_at(annotation.centre).*side);
    sum += error * error;
    residuals.max_px = std::max(residuals.max_px, error);
  }
  residuals.rms_px = std::sqrt(sum / static_cast<double>(annotations.size()));
  return residuals;
}

}  // namespace puck
