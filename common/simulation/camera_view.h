#pragma once

#include <array>
#include <optional>

#include "common/events/sensor_size.h"
#include "common/simulation/camera_params.h"
#include "common/simulation/simulated_truth.h"
#include "common/simulation/vector3.h"
#include "common/table/homography.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// A pinhole camera above the table, in its home pose or rotated about its centre.
class CameraView {
 public:
  struct Projection {
    Pixel pixel;
    double depth_m = 0;  ///< Along the optical axis.
  };

  /// In its home pose.
  CameraView(const CameraParams& params, SensorSize size);

  /// The same camera, rotated about its centre. Call it on the home pose only.
  CameraView turned(const HeadPose& pose) const;

  Vector3 centre() const { return centre_; }
  Vector3 right() const { return right_; }
  Vector3 down() const { return down_; }
  Vector3 forward() const { return forward_; }
  SensorSize size() const { return size_; }
  double focal_px() const { return focal_px_; }
  Pixel principal_point() const { return principal_point_; }

  /// Direction of the pixel's ray, in the table's frame; its component along the optical axis is 1.
  Vector3 ray(Pixel pixel) const;
  /// `std::nullopt` for a point less than 1 cm in front of the camera.
  std::optional<Projection> project(Vector3 point) const;

  /// Row-major homography: the homogeneous pixel of a point (x, y, 1) of the plane at a height
  /// above the playing surface.
  std::array<double, 9> image_from_plane(double height_m) const;
  /// The inverse of `image_from_plane`, as a calibration file states it.
  Homography table_from_image(double height_m) const;

 private:
  Vector3 centre_;
  Vector3 right_;
  Vector3 down_;
  Vector3 forward_;
  SensorSize size_;
  double focal_px_ = 0;
  Pixel principal_point_;
};

}  // namespace puck
