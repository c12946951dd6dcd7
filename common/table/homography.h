#pragma once

#include <array>
#include <optional>

#include "common/table/matrix.h"
#include "common/table/table_point.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// Maps the image to the table's plane. The only conversion from a Pixel to a TablePoint.
class Homography {
 public:
  /// Row-major; table (m) from image (px). The sign of all nine together is free: the table's
  /// origin is assumed to lie in front of the camera. Throws std::invalid_argument when a
  /// coefficient is not finite or the matrix is singular.
  explicit Homography(const std::array<double, 9>& table_from_image);

  /// From the projection of (x, y, 1) on the table, with a third coordinate that is positive in
  /// front of the camera: the sign is kept, so that the table's origin may lie behind the camera.
  /// `std::nullopt` when the matrix is not finite or singular: the camera lies in the plane.
  static std::optional<Homography> of_view(const Matrix3& image_from_table);

  /// `std::nullopt` for a pixel on or above the horizon.
  std::optional<TablePoint> to_table(Pixel pixel) const;
  /// `std::nullopt` for a point behind the camera.
  std::optional<Pixel> to_image(TablePoint point) const;

  /// d(table)/d(image) at a pixel, m/px: maps velocities and covariances. `to_table` must be
  /// defined for the pixel.
  Matrix2 jacobian_at(Pixel pixel) const;

  /// As the constructor takes them.
  std::array<double, 9> coefficients() const;
  const Matrix3& table_from_image() const { return table_from_image_; }
  const Matrix3& image_from_table() const { return image_from_table_; }

 private:
  Homography(const Matrix3& table_from_image, const Matrix3& image_from_table)
      : table_from_image_(table_from_image), image_from_table_(image_from_table) {}

  Matrix3 table_from_image_;
  Matrix3 image_from_table_;
};

}  // namespace puck
