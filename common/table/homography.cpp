#include "common/table/homography.h"

#include <cmath>
#include <stdexcept>

#include <Eigen/LU>

namespace puck {
namespace {

Matrix3 rows_of(const std::array<double, 9>& c) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(c.data());
}

// Against the scale of a determinant for a matrix of this norm.
bool can_be_inverted(const Matrix3& h) {
  return std::abs(h.determinant()) > 1e-15 * std::pow(h.norm(), 3);
}

Matrix3 checked_inverse(const Matrix3& h) {
  if (!h.allFinite()) throw std::invalid_argument("a homography needs nine finite coefficients");
  if (!can_be_inverted(h)) {
    throw std::invalid_argument("a homography's matrix must be invertible");
  }
  return h.inverse();
}

}  // namespace

Homography::Homography(const std::array<double, 9>& table_from_image)
    : table_from_image_(rows_of(table_from_image)),
      image_from_table_(checked_inverse(table_from_image_)) {
  // The sign of the nine coefficients is free. It is chosen so that the table in front of the
  // camera has a positive third coordinate both ways: the table's origin lies in front of every
  // camera that can see the table from its home pose.
  if (image_from_table_(2, 2) < 0) {
    image_from_table_ *= -1;
    table_from_image_ *= -1;
  }
}

std::optional<Homography> Homography::of_view(const Matrix3& image_from_table) {
  if (!image_from_table.allFinite() || !can_be_inverted(image_from_table)) return std::nullopt;
  return Homography(image_from_table.inverse(), image_from_table);
}

std::array<double, 9> Homography::coefficients() const {
  std::array<double, 9> list{};
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(list.data()) = table_from_image_;
  return list;
}

std::optional<TablePoint> Homography::to_table(Pixel pixel) const {
  const Column3 h = table_from_image_ * Column3(pixel.x, pixel.y, 1);
  if (!(h.z() > 0)) return std::nullopt;
  return TablePoint{h.x() / h.z(), h.y() / h.z()};
}

std::optional<Pixel> Homography::to_image(TablePoint point) const {
  const Column3 h = image_from_table_ * Column3(point.x_m, point.y_m, 1);
  if (!(h.z() > 0)) return std::nullopt;
  return Pixel{h.x() / h.z(), h.y() / h.z()};
}

Matrix2 Homography::jacobian_at(Pixel pixel) const {
  const Column3 h = table_from_image_ * Column3(pixel.x, pixel.y, 1);
  const Eigen::Vector2d place = h.head<2>() / h.z();
  return (table_from_image_.topLeftCorner<2, 2>() -
          place * table_from_image_.bottomLeftCorner<1, 2>()) /
         h.z();
}

}  // namespace puck
