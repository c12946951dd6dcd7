#pragma once

#include "common/vision/pixel.h"
#include "common/vision/ring_samples.h"

namespace puck {

struct PeakRefinementParams {
  /// Half the width of the soft ring, px. Wider finds the peak from farther away; narrower lets
  /// less of what is beside the contour in.
  double half_width_px = 2.5;
  int iterations = 4;
  /// The peak is placed at most so far from where the search for it begins, px.
  double farthest_px = 2;
};

/// The peak of a soft ring's correlation with a picture.
struct RefinedPeak {
  Pixel shift;  ///< From where the samples were gathered, px.
  /// How strongly the picture holds the peak in place, weighted pixels: the curvature's matrix.
  double hold_xx = 0;
  double hold_xy = 0;
  double hold_yy = 0;
};

/// Places the ring's peak between pixels. The ring's profile is (1 − (d / half width)²)², so the
/// correlation, Σ grey · profile(distance), is climbed by the shift that brings the pixels'
/// weighted distances closest to zero, again and again: at a peak nothing moves any more. Nothing
/// to hold on to in a direction means no shift in it.
RefinedPeak refine_peak(const RingSamples& samples, const PeakRefinementParams& params);

}  // namespace puck
