#pragma once

#include <span>

#include "common/calibration/size_residuals.h"
#include "common/vision/geometry/annotation.h"
#include "common/vision/geometry/disc_model.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

struct DiscFit {
  DiscModel model;
  SizeResiduals width;
  SizeResiduals height;
};

/// Least squares over widths and heights jointly. `middle`: centre of the image; it gives the
/// principal point's row, and a prior for its column. The annotations must suit
/// `fit_puck_size_model`.
DiscFit fit_disc_model(std::span<const Annotation> annotations, Pixel middle);

}  // namespace puck
