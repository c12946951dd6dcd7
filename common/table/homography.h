#pragma once

#include <array>
#include <optional>

#include "common/table/matrix3.h"
#include "common/table/table_point.h"
#include "common/vision/pixel.h"

namespace puck {

/// Maps the image to the table's plane. The only way from a Pixel to a TablePoint.
class Homography {
 public:
  /// Row by row; table (m) from image (px). The sign of all nine together is free: the table's
  /// origin is taken to lie in front of the camera. Throws std::invalid_argument when a coefficient
  /// is not finite or the matrix cannot be inverted.
  explicit Homography(const Matrix3& table_from_image);

  /// Of a camera whose view of (x, y, 1) on the table is known, with the third coordinate positive
  /// in front of the camera: its sign is kept, so that the table's origin may lie behind it.
  /// Nothing when the matrix is not finite or cannot be inverted: the camera lies in the plane.
  static std::optional<Homography> of_view(const Matrix3& image_from_table);

  /// Nothing for a pixel on or above the horizon.
  std::optional<TablePoint> to_table(Pixel pixel) const;
  /// Nothing for a point behind the camera.
  std::optional<Pixel> to_image(TablePoint point) const;

  /// d(table)/d(image) at a pixel, row by row, m/px: carries velocities and covariances over.
  /// The pixel must be one that `to_table` maps.
  std::array<double, 4> jacobian_at(Pixel pixel) const;

  const Matrix3& table_from_image() const { return table_from_image_; }
  const Matrix3& image_from_table() const { return image_from_table_; }

 private:
  Homography(const Matrix3& table_from_image, const Matrix3& image_from_table)
      : table_from_image_(table_from_image), image_from_table_(image_from_table) {}

  Matrix3 table_from_image_;
  Matrix3 image_from_table_;
};

}  // namespace puck
