#pragma once

#include <cstdint>

#include "common/events/sensor_size.h"
#include "common/vision/contour/puck_contour.h"
#include "common/vision/contour/ring_samples.h"
#include "common/vision/geometry/image.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// The soft ring at the true contour, which finishes what the kernels' hard rings begin: measures a
/// puck's place to a fraction of a pixel, and how much it looks like a puck.
class SoftRing {
 public:
  struct Fit {
    Pixel position;
    double score = 0;  ///< ring_score there.
  };

  SoftRing(SensorSize sensor, const PuckSizeModel& size_model,
           const ContourCalibration& calibration, bool other_wall = false)
      : contour_(sensor, size_model, calibration), other_wall_(other_wall) {}

  /// Begins at `start`, which should be at most about a pixel off. `place` is where the picture, a
  /// surface as it was copied, lies in the image.
  Fit fit(ImageView<const std::uint8_t> picture, const Region& place, Pixel start);

 private:
  // The ring's shift from there.
  Pixel look(ImageView<const std::uint8_t> picture, const Region& place, Pixel start);

  PuckContour contour_;
  bool other_wall_;
  RingSamples samples_;
};

}  // namespace puck
