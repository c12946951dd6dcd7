#pragma once

#include <array>
#include <optional>

#include "common/table/head_pose.h"
#include "common/table/homography.h"
#include "common/table/table_view.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// A pinhole camera without distortion and with square pixels: needed besides the homography when
/// the head moves or an object lies above the calibrated plane.
struct PinholeCamera {
  double focal_px = 0;
  Pixel principal_point;
  /// Point where the head's axes meet, in the frame of the camera at home: right, down, forwards,
  /// m. Rotation about a point other than the camera's centre also translates the camera.
  std::array<double, 3> pivot_m{};
};

/// The table as seen by a camera in its home pose or turned with a head.
class TableCamera {
 public:
  /// `home`: for the pose in which all angles of HEAD are 0. Throws std::invalid_argument that
  /// names the key when a value is out of range.
  TableCamera(const Homography& home, const PinholeCamera& camera);

  /// The table as the turned camera sees it; `std::nullopt` when it sees the table edge-on.
  std::optional<TableView> view_at(const HeadPose& pose) const;

  /// The homography of the plane that lies `height_m` above the one of `home`, in the home pose.
  /// Throws std::invalid_argument when the camera lies in that plane.
  Homography raised(double height_m) const;

 private:
  PinholeCamera camera_;
  // A point (x, y, 1) of the plane in the camera's frame at home, times `scale_`.
  Matrix3 camera_from_table_;
  double scale_ = 0;
};

}  // namespace puck
