#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "common/calibration/disc_fit.h"
#include "common/calibration/size_fit.h"
#include "common/events/sensor_size.h"
#include "common/vision/geometry/annotation.h"
#include "common/vision/geometry/puck_size_model.h"

namespace puck {

/// An annotation that neither model explains.
struct SizeOutlier {
  std::size_t row = 0;  ///< From 1, in the order in which they were given.
  Annotation annotation;
  PuckSize expected;  ///< By Equation (2), fitted without it.
};

/// The fitted size models and the limits of their validity.
struct SizeCalibration {
  /// Equation (2), with the disc model where there are enough annotations and it explains them no
  /// worse.
  PuckSizeModel model;
  SizeFit planes;  ///< The paper's Equation (2), without outliers.
  DiscFit disc;    ///< The disc model, from the same annotations.
  std::vector<SizeOutlier> outliers;
  /// Bounding box of all centres used.
  Pixel from;
  Pixel to;
  /// Limits of the annotations, one line each.
  std::vector<std::string> warnings;
};

/// Fits both models. Removes the worst annotation repeatedly, as long as its width or height is off
/// by more than 1 px and by more than 3.5 robust standard deviations (from the median absolute
/// deviation) in both models, and three quarters remain. `sensor`: {0, 0} if unknown. Throws
/// std::invalid_argument as `fit_puck_size_model` does, and for a centre outside the sensor.
SizeCalibration calibrate_size(std::span<const Annotation> annotations, SensorSize sensor);

}  // namespace puck
