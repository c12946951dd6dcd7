#pragma once

#include <optional>

#include "common/table/homography.h"
#include "common/table/matrix.h"
#include "common/table/puck_track.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// Position and velocity of the puck's centre in the image, and their uncertainty.
struct ImageTrack {
  Pixel position;
  PixelVelocity velocity;
  /// Covariance of (x, y, vx, vy); px², px²/s, px²/s².
  Matrix4 covariance = Matrix4::Zero();
};

/// The table in the image at one moment, and its motion in the image as the camera turns.
class TableView {
 public:
  /// For a camera that stands still.
  explicit TableView(const Homography& homography) : homography_(homography) {}
  /// `table_from_image_rate`: the derivative of the homography's coefficients, 1/s.
  TableView(const Homography& homography, const Matrix3& table_from_image_rate)
      : homography_(homography), rate_(table_from_image_rate) {}

  const Homography& homography() const { return homography_; }

  /// Maps position, velocity and their covariance, by their exact derivatives. The camera's
  /// rotation is taken out of the velocity: a puck at rest on the table is at rest, however the
  /// camera turns. `std::nullopt` for a pixel on or above the horizon.
  std::optional<PuckTrack> to_table(const ImageTrack& seen) const;

 private:
  Homography homography_;
  Matrix3 rate_ = Matrix3::Zero();
};

}  // namespace puck
