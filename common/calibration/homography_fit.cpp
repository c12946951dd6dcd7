#include "common/calibration/homography_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>

#include <Eigen/Dense>

#include "common/calibration/least_squares.h"

namespace puck {
namespace {

using PointColumns = Eigen::Matrix2Xd;
using Elements = Eigen::VectorXd;  // Eight; the ninth element is 1.

constexpr std::size_t kMinCorrespondences = 4;
// Of the second smallest singular value of the linear system to its largest. In normalised
// coordinates a good layout reaches 0.1; points on one line stay near the noise of the marking.
constexpr double kMinConditioning = 1e-3;

struct Normalised {
  PointColumns points;
  Eigen::Matrix3d transform;  // normalised from original
};

// Moves the centroid to the origin and the mean distance from it to √2.
Normalised normalised(const PointColumns& points, const char* what) {
  const Eigen::Vector2d mean = points.rowwise().mean();
  const PointColumns centred = points.colwise() - mean;
  const double distance = centred.colwise().norm().mean();
  if (!(distance > 0)) {
    throw std::invalid_argument(std::string("all ") + what + " points are the same");
  }
  const double scale = std::sqrt(2.0) / distance;
  Eigen::Matrix3d transform;
  transform << scale, 0, -scale * mean.x(), 0, scale, -scale * mean.y(), 0, 0, 1;
  return {centred * scale, transform};
}

// The matrix whose null vector is the homography that carries `from` to `to`.
Eigen::MatrixXd linear_system(const PointColumns& from, const PointColumns& to) {
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(2 * from.cols(), 9);
  for (Eigen::Index i = 0; i < from.cols(); ++i) {
    const Eigen::RowVector3d p = from.col(i).homogeneous().transpose();
    system.row(2 * i) << p, 0, 0, 0, -to(0, i) * p;
    system.row(2 * i + 1) << 0, 0, 0, p, -to(1, i) * p;
  }
  return system;
}

Eigen::Matrix3d direct_linear_transform(const PointColumns& from, const PointColumns& to) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(linear_system(from, to), Eigen::ComputeFullV);
  const auto& values = svd.singularValues();
  if (values(7) < kMinConditioning * values(0)) {
    throw std::invalid_argument(
        "the correspondences do not fix a homography: at least four must lie so that no three of "
        "them are on one line");
  }
  const Eigen::Matrix<double, 9, 1> h = svd.matrixV().col(8);
  Eigen::Matrix3d result;
  result << h(0), h(1), h(2), h(3), h(4), h(5), h(6), h(7), h(8);
  return result;
}

Eigen::Matrix3d to_matrix(const Elements& p) {
  Eigen::Matrix3d matrix;
  matrix << p(0), p(1), p(2), p(3), p(4), p(5), p(6), p(7), 1;
  return matrix;
}

// Smallest squared distances between `to` and the carried `from`.
Eigen::Matrix3d refined(const Eigen::Matrix3d& start, const PointColumns& from,
                        const PointColumns& to) {
  const Eigen::Matrix3d scaled = start / start(2, 2);
  Elements parameters(8);
  parameters << scaled(0, 0), scaled(0, 1), scaled(0, 2), scaled(1, 0), scaled(1, 1), scaled(1, 2),
      scaled(2, 0), scaled(2, 1);
  return to_matrix(least_squares(
      parameters, to.size(), [&](const Eigen::VectorXd& p, Eigen::VectorXd& residuals) {
        const PointColumns carried =
            (to_matrix(p) * from.colwise().homogeneous()).colwise().hnormalized();
        residuals = (carried - to).reshaped();
      }));
}

Homography to_homography(const Eigen::Matrix3d& table_from_image) {
  const Eigen::Matrix3d m = table_from_image / table_from_image.norm();
  return Homography(
      {m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)});
}

HomographyFit with_residuals(const Homography& homography,
                             std::span<const Correspondence> correspondences) {
  HomographyFit fit{homography};
  double sum_px = 0;
  double sum_m = 0;
  for (std::size_t i = 0; i < correspondences.size(); ++i) {
    const Correspondence& c = correspondences[i];
    const std::optional<Pixel> pixel = homography.to_image(c.table);
    const std::optional<TablePoint> point = homography.to_table(c.image);
    if (!pixel || !point) {
      throw std::invalid_argument("correspondence " + std::to_string(i + 1) +
                                  " would lie behind the camera: the correspondences contradict "
                                  "each other, perhaps two are swapped");
    }
    const double error_px = std::hypot(pixel->x - c.image.x, pixel->y - c.image.y);
    const double error_m = std::hypot(point->x_m - c.table.x_m, point->y_m - c.table.y_m);
    sum_px += error_px * error_px;
    sum_m += error_m * error_m;
    fit.max_px = std::max(fit.max_px, error_px);
    fit.max_m = std::max(fit.max_m, error_m);
  }
  const auto count = static_cast<double>(correspondences.size());
  fit.rms_px = std::sqrt(sum_px / count);
  fit.rms_m = std::sqrt(sum_m / count);
  return fit;
}

}  // namespace

HomographyFit fit_homography(std::span<const Correspondence> correspondences) {
  if (correspondences.size() < kMinCorrespondences) {
    throw std::invalid_argument("the table needs at least " + std::to_string(kMinCorrespondences) +
                                " correspondences, got " + std::to_string(correspondences.size()));
  }
  const auto count = static_cast<Eigen::Index>(correspondences.size());
  PointColumns image(2, count);
  PointColumns table(2, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Correspondence& c = correspondences[static_cast<std::size_t>(i)];
    image.col(i) << c.image.x, c.image.y;
    table.col(i) << c.table.x_m, c.table.y_m;
  }
  if (!image.allFinite() || !table.allFinite()) {
    throw std::invalid_argument("every coordinate of a correspondence must be finite");
  }

  // Fitted as image from table, because the marking's error is made in the image.
  const Normalised to = normalised(image, "image");
  const Normalised from = normalised(table, "table");
  const Eigen::Matrix3d fitted =
      refined(direct_linear_transform(from.points, to.points), from.points, to.points);
  const Eigen::Matrix3d table_from_image =
      from.transform.inverse() * fitted.inverse() * to.transform;
  if (!table_from_image.allFinite()) {
    throw std::invalid_argument("the correspondences do not fix a homography");
  }
  return with_residuals(to_homography(table_from_image), correspondences);
}

}  // namespace puck
