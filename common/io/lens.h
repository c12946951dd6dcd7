#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/events/sensor_size.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// A camera's lens in OpenCV's models, as `calibrateCamera` and `fisheye::calibrate` fit them.
struct Lens {
  enum class Model : std::uint8_t { kPinhole, kFisheye };

  Model model = Model::kPinhole;
  SensorSize sensor;  ///< Of the pictures that it was fitted on.
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;
  double cy_px = 0;
  /// Pinhole: k1, k2, p1, p2, k3. Fisheye: k1, k2, k3, k4.
  std::array<double, 5> distortion{};

  /// Where a camera without distortion, of the same focal lengths and centre, sees what this one
  /// sees at `seen`. Nothing where the model has no such point: beyond the radius at which it
  /// folds over, or 90 degrees off the axis.
  std::optional<Pixel> undistorted(Pixel seen) const;
};

}  // namespace puck
