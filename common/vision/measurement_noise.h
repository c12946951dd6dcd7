#pragma once

#include "common/vision/peak_refinement.h"
#include "common/vision/pixel_motion.h"

namespace puck {

/// How far off a soft ring's peak is.
struct MeasurementNoiseParams {
  /// Standard deviation that no amount of bright pixels takes away, px: the size model's errors and
  /// whatever else the surface remembers from one step to the next.
  double floor_px = 0.05;
  /// Variance of the distance from the contour at which a bright pixel lies, px².
  double pixel_px2 = 0.06;
};

/// The variance of a peak along each axis: less the more strongly the picture holds it there.
PixelVariance measurement_variance(const RefinedPeak& peak, const MeasurementNoiseParams& params);

}  // namespace puck
