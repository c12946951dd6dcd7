#pragma once

#include <span>

#include "common/calibration/size_residuals.h"
#include "common/vision/geometry/annotation.h"
#include "common/vision/geometry/puck_size_model.h"

namespace puck {

struct SizeFit {
  /// Sizes are clamped to between half the smallest annotated one and twice the largest.
  PuckSizeModel model;
  SizeResiduals width;
  SizeResiduals height;
};

/// Least squares fit of the paper's Equation (2). Throws std::invalid_argument with the reason when
/// there are fewer than three annotations, one is not finite or has no size, most of the boxes lie
/// across the image's top left corner, as when columns are mixed up, or the centres coincide or are
/// collinear to within a pixel, so that the growth across the line is unknown.
SizeFit fit_puck_size_model(std::span<const Annotation> annotations);

}  // namespace puck
