#include "common/calibration/size_fit.h"

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include <Eigen/Dense>

namespace puck {
namespace {

constexpr std::size_t kMinAnnotations = 3;
// Standard deviation of the centres across their main direction, px.
constexpr double kMinSpreadPx = 1.0;

void check(std::span<const SizeAnnotation> annotations) {
  if (annotations.size() < kMinAnnotations) {
    throw std::invalid_argument("the size model needs at least " + std::to_string(kMinAnnotations) +
                                " annotations, got " + std::to_string(annotations.size()));
  }
  for (std::size_t i = 0; i < annotations.size(); ++i) {
    const SizeAnnotation& a = annotations[i];
    const bool finite = std::isfinite(a.centre.x) && std::isfinite(a.centre.y) &&
                        std::isfinite(a.size.width) && std::isfinite(a.size.height);
    if (!finite || a.size.width <= 0 || a.size.height <= 0) {
      throw std::invalid_argument("annotation " + std::to_string(i + 1) +
                                  " needs a finite centre and a positive width and height");
    }
  }
}

SizeResiduals residuals_of(const Eigen::VectorXd& difference) {
  return {std::sqrt(difference.squaredNorm() / static_cast<double>(difference.size())),
          difference.cwiseAbs().maxCoeff()};
}

}  // namespace

SizeFit fit_puck_size_model(std::span<const SizeAnnotation> annotations) {
  check(annotations);
  const auto count = static_cast<Eigen::Index>(annotations.size());
  Eigen::MatrixX2d centres(count, 2);
  Eigen::VectorXd widths(count);
  Eigen::VectorXd heights(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const SizeAnnotation& a = annotations[static_cast<std::size_t>(i)];
    centres.row(i) << a.centre.x, a.centre.y;
    widths(i) = a.size.width;
    heights(i) = a.size.height;
  }

  // About the mean the problem is well conditioned, and its singular values say how far the
  // centres spread.
  const Eigen::RowVector2d mean = centres.colwise().mean();
  const Eigen::MatrixX2d centred = centres.rowwise() - mean;
  const Eigen::JacobiSVD<Eigen::MatrixX2d> svd(centred);
  const double spread_px = svd.singularValues()(1) / std::sqrt(static_cast<double>(count));
  if (spread_px < kMinSpreadPx) {
    throw std::invalid_argument(
        "the annotated centres lie on one line or in one place; mark the puck all over the table");
  }

  // Equation (2)
  const auto solver = centred.colPivHouseholderQr();
  const double mean_width = widths.mean();
  const double mean_height = heights.mean();
  const Eigen::Vector2d width_slope = solver.solve((widths.array() - mean_width).matrix());
  const Eigen::Vector2d height_slope = solver.solve((heights.array() - mean_height).matrix());

  SizeFit fit;
  fit.model = {mean_width - mean.dot(width_slope),   width_slope(0),  width_slope(1),
               mean_height - mean.dot(height_slope), height_slope(0), height_slope(1)};
  fit.width = residuals_of((widths.array() - mean_width).matrix() - centred * width_slope);
  fit.height = residuals_of((heights.array() - mean_height).matrix() - centred * height_slope);
  return fit;
}

}  // namespace puck
