#pragma once

#include <cstddef>
#include <span>

#include "common/calibration/contour_samples.h"
#include "common/vision/contour_calibration.h"

namespace puck {

struct ContourFit {
  ContourCalibration calibration;
  /// One standard deviation of each value, told from how much it differs between twenty parts of
  /// the recording.
  ContourCalibration standard_error;
  std::size_t events = 0;
  /// How far the events lie from where they are expected, robustly: the standard deviation of a
  /// normal distribution with the same median absolute deviation; with what was assumed before the
  /// fit, and after it.
  double spread_before_px = 0;
  double spread_px = 0;
  /// Left over on the contour's front and back, and on its upper and lower edge: medians, px,
  /// positive outside.
  double front_px = 0;
  double back_px = 0;
  double upper_px = 0;
  double lower_px = 0;
  /// Of the contour along its normal: nine tenths of the events are slower.
  double fast_px_s = 0;
};

/// Fits the sensor's lag τ, the trail, the wall's share and the ring's growth at once: an event's
/// distance from the ring is expected to be −τ n·v − trail sign(n·v), because events appear where
/// the contour was τ ago. Where the speeds are too much alike to tell τ and trail apart, the trail
/// stays 0.
/// Iteratively reweighted least squares with Cauchy's weights; events more than 4 px off are left
/// out. What the events leave open stays at its default. Throws std::invalid_argument with the
/// reason when there are fewer than 1000 events, or the contour was too slow to tell the lag to
/// 50 µs.
ContourFit fit_contour(std::span<const ContourSample> samples);

}  // namespace puck
