#include "common/calibration/size_fit.h"

#include <algorithm>
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

// Beyond the annotated sizes, so that places beyond the marked ones keep their own size, within
// reason.
constexpr double kMargin = 2;

void check_values(std::span<const Annotation> annotations) {
  if (annotations.size() < kMinAnnotations) {
    throw std::invalid_argument("the size model needs at least " + std::to_string(kMinAnnotations) +
                                " annotations, got " + std::to_string(annotations.size()));
  }
  for (std::size_t i = 0; i < annotations.size(); ++i) {
    const Annotation& a = annotations[i];
    const bool finite = std::isfinite(a.centre.x) && std::isfinite(a.centre.y) &&
                        std::isfinite(a.size.width) && std::isfinite(a.size.height);
    if (!finite || a.size.width <= 0 || a.size.height <= 0) {
      throw std::invalid_argument("annotation " + std::to_string(i + 1) +
                                  " needs a finite centre and a positive width and height");
    }
  }
}

void check_columns(std::span<const Annotation> annotations) {
  const auto across_corner =
      std::count_if(annotations.begin(), annotations.end(), [](const Annotation& a) {
        return a.centre.x < a.size.width / 2 && a.centre.y < a.size.height / 2;
      });
  if (2 * static_cast<std::size_t>(across_corner) > annotations.size()) {
    throw std::invalid_argument(
        "most of the annotated boxes reach beyond the image's left and upper borders; are the "
        "columns in the order that the header says?");
  }
}

// Standard deviation of the centres, about their mean, across their main direction.
double spread_px(const Eigen::MatrixX2d& centred) {
  const Eigen::JacobiSVD<Eigen::MatrixX2d> svd(centred);
  return svd.singularValues()(1) / std::sqrt(static_cast<double>(centred.rows()));
}

void check_spread(const Eigen::MatrixX2d& centred) {
  if (centred.cwiseAbs().maxCoeff() < kMinSpreadPx) {
    throw std::invalid_argument(
        "the annotated centres are all in one place; mark the puck all over the table");
  }
  if (spread_px(centred) < kMinSpreadPx) {
    throw std::invalid_argument(
        "the annotated centres lie on one line; mark the puck all over the table");
  }
}

void limit_sizes(std::span<const Annotation> annotations, PuckSizeModel& model) {
  for (double PuckSize::*side : {&PuckSize::width, &PuckSize::height}) {
    const auto [least, most] = std::minmax_element(
        annotations.begin(), annotations.end(),
        [side](const Annotation& a, const Annotation& b) { return a.size.*side < b.size.*side; });
    model.smallest.*side = std::max(1.0, least->size.*side / kMargin);
    model.largest.*side = std::max(1.0, most->size.*side * kMargin);
  }
}

}  // namespace

SizeFit fit_puck_size_model(std::span<const Annotation> annotations) {
  check_values(annotations);
  check_columns(annotations);
  const auto count = static_cast<Eigen::Index>(annotations.size());
  Eigen::MatrixX2d centres(count, 2);
  Eigen::VectorXd widths(count);
  Eigen::VectorXd heights(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Annotation& a = annotations[static_cast<std::size_t>(i)];
    centres.row(i) << a.centre.x, a.centre.y;
    widths(i) = a.size.width;
    heights(i) = a.size.height;
  }

  // About the mean the problem is well conditioned.
  const Eigen::RowVector2d mean = centres.colwise().mean();
  const Eigen::MatrixX2d centred = centres.rowwise() - mean;
  check_spread(centred);

  // Equation (2)
  const auto solver = centred.colPivHouseholderQr();
  const double mean_width = widths.mean();
  const double mean_height = heights.mean();
  const Eigen::Vector2d width_slope = solver.solve((widths.array() - mean_width).matrix());
  const Eigen::Vector2d height_slope = solver.solve((heights.array() - mean_height).matrix());

  SizeFit fit;
  fit.model = {mean_width - mean.dot(width_slope),   width_slope(0),  width_slope(1),
               mean_height - mean.dot(height_slope), height_slope(0), height_slope(1)};
  limit_sizes(annotations, fit.model);
  const auto size_at = [&](Pixel position) { return fit.model.extrapolated_at(position); };
  fit.width = residuals_of(annotations, &PuckSize::width, size_at);
  fit.height = residuals_of(annotations, &PuckSize::height, size_at);
  return fit;
}

}  // namespace puck
