#include "common/calibration/disc_fit.h"

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include "common/calibration/least_squares.h"
#include "common/calibration/size_fit.h"

namespace puck {
namespace {

// Priors keep parameters that the annotations hardly determine near those of most cameras and
// pucks. The weights suit annotations good to half a pixel.
constexpr double kAnnotationErrorPx = 0.5;
constexpr double kColumnSpreadPx = 100;
constexpr double kUsualThickness = 0.2;
constexpr double kThicknessSpread = 0.2;

enum Parameter : Eigen::Index { kWidth, kGrowthX, kGrowthY, kFaceOn, kThickness, kColumn, kCount };

// The width's plane goes through `middle`, where it is best determined.
DiscModel model_of(const Eigen::VectorXd& parameters, Pixel middle) {
  DiscModel model;
  model.width_x = parameters(kGrowthX);
  model.width_y = parameters(kGrowthY);
  model.width_0 = parameters(kWidth) - model.width_x * middle.x - model.width_y * middle.y;
  model.face_on_px = std::max(parameters(kFaceOn), DiscModel::kSmallestWidth_px);
  model.thickness = std::max(parameters(kThickness), 0.0);
  model.principal_x_px = parameters(kColumn);
  model.principal_y_px = middle.y;
  return model;
}

}  // namespace

DiscFit fit_disc_model(std::span<const Annotation> annotations, Pixel middle) {
  const PuckSizeModel planes = fit_puck_size_model(annotations).model;
  const PuckSize typical = planes.extrapolated_at(middle);
  Eigen::VectorXd start(static_cast<Eigen::Index>(kCount));
  // The wall makes up a fifth of the height.
  start << typical.width, planes.width_x, planes.width_y,
      typical.width * typical.width / std::max(0.8 * typical.height, DiscModel::kSmallestWidth_px),
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
