#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/calibration/disc_fit.h"
#include "common/calibration/size_fit.h"
#include "common/events/sensor_size.h"
#include "common/vision/annotation.h"
#include "common/vision/puck_size_model.h"

namespace puck {

/// An annotation that neither model explains.
struct SizeOutlier {
  std::size_t row = 0;  ///< From 1, in the order in which they were given.
  Annotation annotation;
  PuckSize expected;  ///< By Equation (2) without it.
};

/// What annotations of the puck's size say, and how far they can be trusted.
struct SizeCalibration {
  /// Equation (2), with the disc beside it where the annotations are enough for that and it
  /// explains them no worse.
  PuckSizeModel model;
  SizeFit planes;  ///< The paper's Equation (2), outliers left out.
  DiscFit disc;    ///< The same annotations.
  std::vector<SizeOutlier> outliers;
  /// The box around all centres that were used.
  Pixel from;
  Pixel to;
  /// What the annotations leave open, one line each.
  std::vector<std::string> warnings;
};

/// Fits both models. Row by row the worst annotation is left out for as long as its width or height
/// is more than 1 px and more than 3.5 robust standard deviations (of the median absolute one) off
/// in both models, and three quarters remain. `sensor`: {0, 0} when it is not known. Throws
/// std::invalid_argument as `fit_puck_size_model` does, and for a centre outside the sensor.
SizeCalibration calibrate_size(std::span<const Annotation> annotations, SensorSize sensor);

}  // namespace puck
