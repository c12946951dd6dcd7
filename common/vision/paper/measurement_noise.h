#pragma once

#include "common/vision/contour/peak_refinement.h"
#include "common/vision/paper/pixel_motion.h"

namespace puck {

/// Position noise of a soft ring's peak.
struct MeasurementNoiseParams {
  /// Standard deviation that remains with any number of bright pixels, px: errors of the size model
  /// and old events on the surface, which steps share.
  double floor_px = 0.05;
  /// Variance of the distance from the contour at which a bright pixel lies, px².
  double pixel_px2 = 0.06;
};

/// Variance of a peak along each axis: the larger the curvature there, the smaller.
PixelVariance measurement_variance(const RefinedPeak& peak, const MeasurementNoiseParams& params);

}  // namespace puck
