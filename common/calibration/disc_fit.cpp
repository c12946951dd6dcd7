#include "common/calibration/disc_fit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <Eigen/Core>

#include "common/calibration/least_squares.h"
#include "common/calibration/size_fit.h"

namespace puck {
namespace {

// What annotations say little about is kept near what most cameras and pucks are. The weights suit
// annotations that are good to half a pixel.
constexpr double kAnnotationErrorPx = 0.5;
constexpr double kColumnSpreadPx = 100;
constexpr double kUsualThickness = 0.2;
constexpr double kThicknessSpread = 0.2;

constexpr double kSmallestWidthPx = 1e-3;
// Growth of the width from row to row, px/px.
constexpr double kLeastGrowth = 0.005;

enum Parameter : Eigen::Index { kWidth, kGrowthX, kGrowthY, kFaceOn, kThickness, kColumn, kCount };

// The width's plane goes through `middle`, where it is known best.
DiscModel model_of(const Eigen::VectorXd& parameters, Pixel middle) {
  DiscModel model;
  model.width_x = parameters(kGrowthX);
  model.width_y = parameters(kGrowthY);
  model.width_0 =
      parameters(kWidth) - model.width_x * middle.x - model.width_y * middle.y;
  model.face_on_px = std::max(parameters(kFaceOn), kSmallestWidthPx);
  model.thickness = parameters(kThickness);
  model.principal_point = {parameters(kColumn), middle.y};
  return model;
}

}  // namespace

double DiscModel::width_at(Pixel position) const {
  return std::max(width_0 + width_x * position.x + width_y * position.y, kSmallestWidthPx);
}

double DiscModel::sine_of_tilt() const {
  return std::clamp(width_at(principal_point) / face_on_px, 0.01, 0.9999);
}

PuckSize DiscModel::at(Pixel position) const {
  const double width = width_at(position);
  const double foreshortening = width / face_on_px;
  const double disc_height = width * foreshortening;
  const double aside = width_y * std::abs(position.x - principal_point.x);
  const double slant = aside / width;
  const double sine = sine_of_tilt();
  const double cosine = std::sqrt(1 - sine * sine);
  const double wall = thickness * width / cosine;
  return {std::hypot(width, slant * disc_height) + wall * sine * aside / face_on_px,
          disc_height + wall * (1 - foreshortening * sine)};
}

double DiscModel::tilt_deg() const { return std::asin(sine_of_tilt()) * 180 / std::numbers::pi; }

double DiscModel::focal_px() const {
  const double sine = sine_of_tilt();
  return face_on_px * std::sqrt(1 - sine * sine) / std::hypot(width_x, width_y);
}

bool DiscModel::has_perspective() const { return width_y > kLeastGrowth; }

DiscFit fit_disc_model(std::span<const Annotation> annotations, Pixel middle) {
  const PuckSizeModel planes = fit_puck_size_model(annotations).model;
  const PuckSize typical = planes.extrapolated_at(middle);
  Eigen::VectorXd start(static_cast<Eigen::Index>(kCount));
  // A fifth of the height is the wall's.
  start << typical.width, planes.width_x, planes.width_y,
      typical.width * typical.width / std::max(0.8 * typical.height, kSmallestWidthPx),
      kUsualThickness, middle.x;

  const auto count = static_cast<Eigen::Index>(annotations.size());
  const Eigen::VectorXd best = least_squares(
      start, 2 * count + 2, [&](const Eigen::VectorXd& parameters, Eigen::VectorXd& residuals) {
        const DiscModel model = model_of(parameters, middle);
        for (Eigen::Index i = 0; i < count; ++i) {
          const Annotation& annotation = annotations[static_cast<std::size_t>(i)];
          const PuckSize size = model.at(annotation.centre);
          residuals(2 * i) = size.width - annotation.size.width;
          residuals(2 * i + 1) = size.height - annotation.size.height;
        }
        residuals(2 * count) =
            kAnnotationErrorPx * (parameters(kColumn) - middle.x) / kColumnSpreadPx;
        residuals(2 * count + 1) =
            kAnnotationErrorPx * (parameters(kThickness) - kUsualThickness) / kThicknessSpread;
      });
  DiscFit fit;
  fit.model = model_of(best, middle);
  const auto size_at = [&](Pixel position) { return fit.model.at(position); };
  fit.width = residuals_of(annotations, &PuckSize::width, size_at);
  fit.height = residuals_of(annotations, &PuckSize::height, size_at);
  return fit;
}

}  // namespace puck
