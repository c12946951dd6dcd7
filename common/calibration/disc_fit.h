#pragma once

#include <span>

#include "common/calibration/size_residuals.h"
#include "common/vision/annotation.h"
#include "common/vision/disc_model.h"
#include "common/vision/pixel.h"

namespace puck {

struct DiscFit {
  DiscModel model;
  SizeResiduals width;
  SizeResiduals height;
};

/// Least squares over widths and heights at once. `middle`: of the image; the principal point's row
/// is taken from it, its column must not lie far from it unless the annotations say so. The
/// annotations must suit `fit_puck_size_model`.
DiscFit fit_disc_model(std::span<const Annotation> annotations, Pixel middle);

}  // namespace puck
