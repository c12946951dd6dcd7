#include "common/table/homography.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace puck {
namespace {

Column3 project(const Matrix3& h, double x, double y) { return product(h, Column3{x, y, 1}); }

// The scale of a determinant for a matrix of this norm.
double cube_of_norm(const Matrix3& h) {
  double sum = 0;
  for (double coefficient : h) sum += coefficient * coefficient;
  return sum * std::sqrt(sum);
}

bool is_finite(const Matrix3& h) {
  return std::all_of(h.begin(), h.end(), [](double value) { return std::isfinite(value); });
}

bool can_be_inverted(const Matrix3& h) {
  return std::abs(determinant(h)) > 1e-15 * cube_of_norm(h);
}

Matrix3 checked_inverse(const Matrix3& h) {
  if (!is_finite(h)) throw std::invalid_argument("a homography needs nine finite coefficients");
  if (!can_be_inverted(h)) {
    throw std::invalid_argument("a homography's matrix must be invertible");
  }
  return inverse(h);
}

}  // namespace

Homography::Homography(const Matrix3& table_from_image)
    : table_from_image_(table_from_image), image_from_table_(checked_inverse(table_from_image)) {
  // The sign of the nine coefficients is free. It is chosen so that the table in front of the
  // camera has a positive third coordinate both ways: the table's origin lies in front of every
  // camera that can see the table from its home pose.
  if (image_from_table_[8] < 0) {
    image_from_table_ = scaled(image_from_table_, -1);
    table_from_image_ = scaled(table_from_image_, -1);
  }
}

std::optional<Homography> Homography::of_view(const Matrix3& image_from_table) {
  if (!is_finite(image_from_table) || !can_be_inverted(image_from_table)) return std::nullopt;
  return Homography(inverse(image_from_table), image_from_table);
}

std::optional<TablePoint> Homography::to_table(Pixel pixel) const {
  const auto [u, v, w] = project(table_from_image_, pixel.x, pixel.y);
  if (!(w > 0)) return std::nullopt;
  return TablePoint{u / w, v / w};
}

std::optional<Pixel> Homography::to_image(TablePoint point) const {
  const auto [u, v, w] = project(image_from_table_, point.x_m, point.y_m);
  if (!(w > 0)) return std::nullopt;
  return Pixel{u / w, v / w};
}

std::array<double, 4> Homography::jacobian_at(Pixel pixel) const {
  const auto [u, v, w] = project(table_from_image_, pixel.x, pixel.y);
  const double x = u / w;
  const double y = v / w;
  const auto& h = table_from_image_;
  return {(h[0] - x * h[6]) / w, (h[1] - x * h[7]) / w, (h[3] - y * h[6]) / w,
          (h[4] - y * h[7]) / w};
}

}  // namespace puck
