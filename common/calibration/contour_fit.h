#pragma once

#include <cstddef>

#include "common/calibration/contour_samples.h"
#include "common/vision/contour/contour_calibration.h"

namespace puck {

struct ContourFit {
  ContourCalibration calibration;
  /// Standard deviation of each value, by a jackknife over twenty parts of the recording.
  ContourCalibration standard_error;
  std::size_t events = 0;
  /// Robust spread of the events' distances from the expected ring, with the defaults and after the
  /// fit: the standard deviation of a normal distribution with the same median absolute deviation.
  double spread_before_px = 0;
  double spread_px = 0;
  /// Median residuals on the contour's front and back, and on its upper and lower edge, px;
  /// positive outside.
  double front_px = 0;
  double back_px = 0;
  double upper_px = 0;
  double lower_px = 0;
  /// 90th percentile of the contour's speed along its normal.
  double fast_px_s = 0;
};

/// Fits the sensor's lag τ, the trail, the wall's share and the ring's growth jointly. An event's
/// expected distance from the ring is −τ n·v − trail sign(n·v), because events appear where the
/// contour was τ ago. Where the speeds are too uniform to separate τ and trail, the trail keeps its
/// default.
/// Iteratively reweighted least squares with Cauchy's weights; events more than 4 px off are
/// ignored. A parameter that the events do not determine keeps its default. Throws
/// std::invalid_argument with the reason when there are fewer than 1000 events, or the contour was
/// too slow to determine the lag to 50 µs.
ContourFit fit_contour(const ContourSamples& samples);

}  // namespace puck
