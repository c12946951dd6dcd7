#include "common/calibration/size_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>

namespace puck {
namespace {

constexpr std::size_t kMinAnnotations = 3;
// Smallest standard deviation of the centres across their main direction, px.
constexpr double kMinSpreadPx = 1.0;

// Factor of the limits beyond the annotated sizes, so that the model may extrapolate to unmarked
// places.
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

// Sums over the annotations, centred on their means.
struct Moments {
  Eigen::Vector2d mean_centre = Eigen::Vector2d::Zero();
  double mean_width = 0;
  double mean_height = 0;
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  Eigen::Vector2d with_width = Eigen::Vector2d::Zero();
  Eigen::Vector2d with_height = Eigen::Vector2d::Zero();
};

Moments moments_of(std::span<const Annotation> annotations) {
  const auto count = static_cast<double>(annotations.size());
  Moments sums;
  for (const Annotation& a : annotations) {
    sums.mean_centre += Eigen::Vector2d(a.centre.x, a.centre.y) / count;
    sums.mean_width += a.size.width / count;
    sums.mean_height += a.size.height / count;
  }
  for (const Annotation& a : annotations) {
    const Eigen::Vector2d centred = Eigen::Vector2d(a.centre.x, a.centre.y) - sums.mean_centre;
    sums.spread += centred * centred.transpose();
    sums.with_width += centred * (a.size.width - sums.mean_width);
    sums.with_height += centred * (a.size.height - sums.mean_height);
  }
  return sums;
}

// `spread`: scatter matrix of `count` centres.
void check_spread(const Eigen::Matrix2d& spread, std::size_t count) {
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver;
  const Eigen::Vector2d squares =
      solver.computeDirect(spread, Eigen::EigenvaluesOnly).eigenvalues();
  const double least = kMinSpreadPx * kMinSpreadPx * static_cast<double>(count);
  if (squares(1) < least) {
    throw std::invalid_argument(
        "the annotated centres are all in one place; mark the puck all over the table");
  }
  // Also refuses NaN, from centres too far apart to square.
  if (!(squares(0) >= least)) {
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
  // Centred, the normal equations are well conditioned: the spread was checked.
  const Moments sums = moments_of(annotations);
  check_spread(sums.spread, annotations.size());

  // Equation (2)
  const Eigen::Matrix2d inverse = sums.spread.inverse();
  const Eigen::Vector2d width_slope = inverse * sums.with_width;
  const Eigen::Vector2d height_slope = inverse * sums.with_height;

  SizeFit fit;
  fit.model = {
      sums.mean_width - sums.mean_centre.dot(width_slope),   width_slope(0),  width_slope(1),
      sums.mean_height - sums.mean_centre.dot(height_slope), height_slope(0), height_slope(1)};
  limit_sizes(annotations, fit.model);
  const auto size_at = [&](Pixel position) { return fit.model.extrapolated_at(position); };
  fit.width = residuals_of(annotations, &PuckSize::width, size_at);
  fit.height = residuals_of(annotations, &PuckSize::height, size_at);
  return fit;
}

}  // namespace puck
