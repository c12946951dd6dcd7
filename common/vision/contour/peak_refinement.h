#pragma once

#include "common/vision/contour/ring_samples.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

struct PeakRefinementParams {
  /// Half the width of the soft ring, px. Wider finds the peak from farther away; narrower admits
  /// fewer pixels beside the contour.
  double half_width_px = 2.5;
  int iterations = 4;
  /// Largest distance of the peak from the start of the search, px.
  double farthest_px = 2;
};

/// The peak of a soft ring's correlation with a picture.
struct RefinedPeak {
  Pixel shift;  ///< From the place of the samples, px.
  /// The curvature's matrix at the peak, weighted pixels.
  double hold_xx = 0;
  double hold_xy = 0;
  double hold_yy = 0;
};

/// Finds the ring's peak between pixels. The ring's profile is (1 − (d / half width)²)², and its
/// correlation is Σ grey · profile(distance). Each iteration shifts the ring so that the pixels'
/// weighted distances come closest to zero; at a peak the shift is zero. A direction without bright
/// pixels gets no shift.
RefinedPeak refine_peak(const RingSamples& samples, const PeakRefinementParams& params);

}  // namespace puck
