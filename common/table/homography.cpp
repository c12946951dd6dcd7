#include "common/table/homography.h"

#include <cmath>
#include <stdexcept>

namespace puck {
namespace {

struct Projected {
  double u = 0;
  double v = 0;
  double w = 0;
};

Projected project(const std::array<double, 9>& h, double x, double y) {
  return {h[0] * x + h[1] * y + h[2], h[3] * x + h[4] * y + h[5], h[6] * x + h[7] * y + h[8]};
}

double determinant_of(const std::array<double, 9>& h) {
  return h[0] * (h[4] * h[8] - h[5] * h[7]) - h[1] * (h[3] * h[8] - h[5] * h[6]) +
         h[2] * (h[3] * h[7] - h[4] * h[6]);
}

std::array<double, 9> inverse_of(const std::array<double, 9>& h, double determinant) {
  std::array<double, 9> inverse{
      h[4] * h[8] - h[5] * h[7], h[2] * h[7] - h[1] * h[8], h[1] * h[5] - h[2] * h[4],
      h[5] * h[6] - h[3] * h[8], h[0] * h[8] - h[2] * h[6], h[2] * h[3] - h[0] * h[5],
      h[3] * h[7] - h[4] * h[6], h[1] * h[6] - h[0] * h[7], h[0] * h[4] - h[1] * h[3]};
  for (double& coefficient : inverse) coefficient /= determinant;
  return inverse;
}

// The scale at which a matrix of this size counts as singular.
double cube_of_norm(const std::array<double, 9>& h) {
  double sum = 0;
  for (double coefficient : h) sum += coefficient * coefficient;
  return sum * std::sqrt(sum);
}

}  // namespace

Homography::Homography(const std::array<double, 9>& table_from_image)
    : table_from_image_(table_from_image) {
  for (double coefficient : table_from_image_) {
    if (!std::isfinite(coefficient)) {
      throw std::invalid_argument("a homography needs nine finite coefficients");
    }
  }
  const double determinant = determinant_of(table_from_image_);
  if (std::abs(determinant) <= 1e-15 * cube_of_norm(table_from_image_)) {
    throw std::invalid_argument("a homography needs a matrix that can be inverted");
  }
  image_from_table_ = inverse_of(table_from_image_, determinant);
  // The homogeneous sign is free. It is chosen so that the table in front of the camera has a
  // positive third coordinate both ways: the table's origin lies in front of every camera that can
  // see the table.
  if (image_from_table_[8] < 0) {
    for (double& coefficient : image_from_table_) coefficient = -coefficient;
    for (double& coefficient : table_from_image_) coefficient = -coefficient;
  }
}

std::optional<TablePoint> Homography::to_table(Pixel pixel) const {
  const Projected point = project(table_from_image_, pixel.x, pixel.y);
  if (!(point.w > 0)) return std::nullopt;
  return TablePoint{point.u / point.w, point.v / point.w};
}

std::optional<Pixel> Homography::to_image(TablePoint point) const {
  const Projected pixel = project(image_from_table_, point.x_m, point.y_m);
  if (!(pixel.w > 0)) return std::nullopt;
  return Pixel{pixel.u / pixel.w, pixel.v / pixel.w};
}

std::array<double, 4> Homography::jacobian_at(Pixel pixel) const {
  const Projected point = project(table_from_image_, pixel.x, pixel.y);
  const double x = point.u / point.w;
  const double y = point.v / point.w;
  const auto& h = table_from_image_;
  return {(h[0] - x * h[6]) / point.w, (h[1] - x * h[7]) / point.w, (h[3] - y * h[6]) / point.w,
          (h[4] - y * h[7]) / point.w};
}

}  // namespace puck
