#pragma once

#include <array>
#include <optional>

#include "common/table/head_pose.h"
#include "common/table/homography.h"
#include "common/table/table_view.h"
#include "common/vision/pixel.h"

namespace puck {

/// A camera without distortion and with square pixels: what must be known of it besides the
/// homography where its head moves or something lies above the calibrated plane.
struct PinholeCamera {
  double focal_px = 0;
  Pixel principal_point;
  /// Where the head's axes meet, seen from the camera at home: to the right, down and forwards, m.
  /// Turning about any other place than the camera's own also moves it.
  std::array<double, 3> pivot_m{};
};

/// A table as a camera sees it that stands in its home pose or turns with a head.
class TableCamera {
 public:
  /// `home`: in the pose in which HEAD has all angles 0. Throws std::invalid_argument that names
  /// the key when a value is out of its range.
  TableCamera(const Homography& home, const PinholeCamera& camera);

  /// The table as the turned camera sees it. Nothing when it sees the table from its edge.
  std::optional<TableView> view_at(const HeadPose& pose) const;

  /// The homography of the plane that lies `height_m` above the one of `home`, in the home pose.
  /// Throws std::invalid_argument when the camera lies in that plane.
  Homography raised(double height_m) const;

 private:
  PinholeCamera camera_;
  // A place (x, y, 1) of the plane in the camera's frame at home, times `scale_`.
  Matrix3 camera_from_table_;
  double scale_ = 0;
};

}  // namespace puck
