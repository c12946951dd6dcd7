#pragma once

#include <array>
#include <optional>

#include "common/table/table_point.h"
#include "common/vision/pixel.h"

namespace puck {

/// Maps the image to the table's plane. The only way from a Pixel to a TablePoint.
class Homography {
 public:
  /// Row by row; table (m) from image (px). Throws std::invalid_argument when a coefficient is not
  /// finite or the matrix cannot be inverted.
  explicit Homography(const std::array<double, 9>& table_from_image);

  /// Nothing for a pixel on or above the horizon.
  std::optional<TablePoint> to_table(Pixel pixel) const;
  /// Nothing for a point behind the camera.
  std::optional<Pixel> to_image(TablePoint point) const;

  /// d(table)/d(image) at a pixel, row by row, m/px: carries velocities and covariances over.
  /// The pixel must be one that `to_table` maps.
  std::array<double, 4> jacobian_at(Pixel pixel) const;

  const std::array<double, 9>& table_from_image() const { return table_from_image_; }

 private:
  std::array<double, 9> table_from_image_;
  std::array<double, 9> image_from_table_;
};

}  // namespace puck
