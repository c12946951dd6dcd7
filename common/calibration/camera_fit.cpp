#include "common/calibration/camera_fit.h"

#include <cmath>
#include <stdexcept>
#include <string>

#include <Eigen/Dense>

#include "common/calibration/least_squares.h"

namespace puck {
namespace {

// ln(focal length), rotation vector, translation.
using CameraParameters = Eigen::Matrix<double, 7, 1>;

constexpr double kLargestSigmaPerPx = 0.05;

[[noreturn]] void refuse_focal_length(const std::string& why) {
  throw std::invalid_argument("the correspondences do not fix the focal length: " + why +
                              "; mark places at more depths, or give the focal length");
}

// The table's axes are orthogonal and of equal length. Their images a and b are so under the image
// of the absolute conic, K⁻ᵀ K⁻¹: two equations that are linear in 1 / f².
double focal_from_axes(const Eigen::Matrix3d& image_from_table) {
  const Eigen::Vector3d a = image_from_table.col(0);
  const Eigen::Vector3d b = image_from_table.col(1);
  const Eigen::Vector2d image_part{a.x() * b.x() + a.y() * b.y(),
                                   a.x() * a.x() + a.y() * a.y() - b.x() * b.x() - b.y() * b.y()};
  const Eigen::Vector2d depth_part{a.z() * b.z(), a.z() * a.z() - b.z() * b.z()};
  const double inverse_square = -image_part.dot(depth_part) / image_part.squaredNorm();
  if (!(inverse_square > 0) || !std::isfinite(inverse_square)) {
    refuse_focal_length("no focal length makes the table's axes orthogonal and equally long");
  }
  return 1 / std::sqrt(inverse_square);
}

CameraParameters start_from(const Eigen::Matrix3d& image_from_table) {
  const double focal_px = focal_from_axes(image_from_table);
  Eigen::Matrix3d view = image_from_table;
  view.topRows<2>() /= focal_px;
  view /= std::sqrt(view.col(0).norm() * view.col(1).norm());
  Eigen::Matrix3d axes;
  axes << view.col(0), view.col(1), view.col(0).cross(view.col(1));
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(axes, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const Eigen::AngleAxisd turn(Eigen::Matrix3d(svd.matrixU() * svd.matrixV().transpose()));
  CameraParameters parameters;
  parameters << std::log(focal_px), turn.angle() * turn.axis(), view.col(2);
  return parameters;
}

// Projection relative to the principal point, px.
Eigen::Vector2d seen(const Eigen::VectorXd& p, const TablePoint& point) {
  const Eigen::Vector3d turn = p.segment<3>(1);
  const double angle = turn.norm();
  const Eigen::AngleAxisd rotation(
      angle, angle > 0 ? Eigen::Vector3d(turn / angle) : Eigen::Vector3d::UnitX());
  const Eigen::Vector3d in_camera =
      rotation * Eigen::Vector3d(point.x_m, point.y_m, 0) + p.tail<3>();
  return std::exp(p(0)) * in_camera.hnormalized();
}

}  // namespace

FocalLengthFit fit_focal_length(const Homography& homography, Pixel principal_point,
                                std::span<const Correspondence> correspondences) {
  Eigen::Matrix3d centred = Eigen::Matrix3d::Identity();
  centred(0, 2) = -principal_point.x;
  centred(1, 2) = -principal_point.y;
  const Eigen::Matrix3d image_from_table = centred * homography.image_from_table();

  const auto count = static_cast<Eigen::Index>(correspondences.size());
  const auto residuals_of = [&](const Eigen::VectorXd& parameters, Eigen::VectorXd& residuals) {
    for (Eigen::Index i = 0; i < count; ++i) {
      const Correspondence& c = correspondences[static_cast<std::size_t>(i)];
      residuals.segment<2>(2 * i) =
          seen(parameters, c.table) -
          Eigen::Vector2d(c.image.x - principal_point.x, c.image.y - principal_point.y);
    }
  };
  const Eigen::VectorXd fitted =
      least_squares(start_from(image_from_table), 2 * count, residuals_of);

  Eigen::VectorXd residuals(2 * count);
  Eigen::MatrixXd slope(2 * count, 7);
  for (Eigen::Index i = 0; i < 7; ++i) {
    constexpr double kStep = 1e-6;
    Eigen::VectorXd after(2 * count);
    Eigen::VectorXd before(2 * count);
    residuals_of(fitted + kStep * Eigen::VectorXd::Unit(7, i), after);
    residuals_of(fitted - kStep * Eigen::VectorXd::Unit(7, i), before);
    slope.col(i) = (after - before) / (2 * kStep);
  }
  const Eigen::MatrixXd covariance = (slope.transpose() * slope).inverse();
  residuals_of(fitted, residuals);

  FocalLengthFit fit;
  fit.focal_px = std::exp(fitted(0));
  fit.sigma_per_px = std::sqrt(covariance(0, 0));
  fit.rms_px = std::sqrt(residuals.squaredNorm() / static_cast<double>(count));
  if (!(fit.sigma_per_px <= kLargestSigmaPerPx)) {
    refuse_focal_length("an error of 1 px in the markings would move it by " +
                        (std::isfinite(fit.sigma_per_px)
                             ? std::to_string(std::lround(100 * fit.sigma_per_px)) + " %"
                             : std::string("any amount")));
  }
  return fit;
}

}  // namespace puck
