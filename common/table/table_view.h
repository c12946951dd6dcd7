#pragma once

#include <optional>

#include "common/table/homography.h"
#include "common/table/matrix4.h"
#include "common/table/puck_track.h"
#include "common/vision/pixel.h"

namespace puck {

/// Where the puck's centre is in the image, how it moves there, and how sure that is.
struct ImageTrack {
  Pixel position;
  PixelVelocity velocity;
  /// Of (x, y, vx, vy), row by row; px², px²/s, px²/s².
  Matrix4 covariance{};
};

/// The table in the image at one moment, and how it moves there because the camera turns.
class TableView {
 public:
  /// Of a camera that stands still.
  explicit TableView(const Homography& homography) : homography_(homography) {}
  /// `table_from_image_rate`: what the homography's coefficients gain a second.
  TableView(const Homography& homography, const Matrix3& table_from_image_rate)
      : homography_(homography), rate_(table_from_image_rate) {}

  const Homography& homography() const { return homography_; }

  /// Carries place, velocity and their covariance over, by their exact derivatives. The camera's
  /// turning is taken out of the velocity: a puck at rest on the table is at rest, however the
  /// camera turns. Nothing for a pixel on or above the horizon.
  std::optional<PuckTrack> to_table(const ImageTrack& seen) const;

 private:
  Homography homography_;
  Matrix3 rate_{};
};

}  // namespace puck
