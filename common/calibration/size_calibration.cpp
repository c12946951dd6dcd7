#include "common/calibration/size_calibration.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <stdexcept>
#include <utility>

#include "common/calibration/median.h"
#include "common/calibration/robust_sigma.h"

namespace puck {
namespace {

constexpr double kOutlierPx = 1;
constexpr double kOutlierSigmas = 3.5;
// With fewer rows, the wrong one cannot be identified.
constexpr std::size_t kFewestForOutliers = 8;
// Share of the image's width and height; below it the models are extrapolated over much of the
// image.
constexpr double kLeastCoverage = 0.5;
// The image of a disc on a table is never much higher than wide.
constexpr double kHighestOfWidth = 1.2;

// With fewer annotations, the error of one may tilt the disc.
constexpr std::size_t kFewestForDisc = 8;
// Limits that no puck and no camera above a table exceeds.
constexpr double kThickestOfWidth = 1;
constexpr double kLeastTilt_deg = 1;
constexpr double kMostTilt_deg = 89;

struct NumberedAnnotation {
  std::size_t row = 0;
  Annotation annotation;
};

struct Fits {
  SizeFit planes;
  DiscFit disc;
};

std::vector<Annotation> without_rows(const std::vector<NumberedAnnotation>& numbered) {
  std::vector<Annotation> annotations;
  for (const NumberedAnnotation& n : numbered) annotations.push_back(n.annotation);
  return annotations;
}

// Each annotation's largest error relative to the allowed one.
template <typename SizeAt>
std::vector<double> excesses_of(std::span<const Annotation> annotations, const SizeAt& size_at) {
  std::vector<double> excesses(annotations.size());
  for (double PuckSize::*side : {&PuckSize::width, &PuckSize::height}) {
    std::vector<double> errors;
    for (const Annotation& a : annotations) {
      errors.push_back(std::abs(a.size.*side - size_at(a.centre).*side));
    }
    const double allowed = std::max(kOutlierPx, kOutlierSigmas * kSigmaOfMedian * median(errors));
    for (std::size_t i = 0; i < errors.size(); ++i) {
      excesses[i] = std::max(excesses[i], errors[i] / allowed);
    }
  }
  return excesses;
}

// An outlier must be one in both models, so that a model's own error does not count.
std::optional<std::size_t> worst_outlier(std::span<const Annotation> annotations,
                                         const Fits& fits) {
  const std::vector<double> by_planes =
      excesses_of(annotations, [&](Pixel p) { return fits.planes.model.extrapolated_at(p); });
  const std::vector<double> by_disc =
      excesses_of(annotations, [&](Pixel p) { return fits.disc.model.at(p); });
  std::size_t worst = 0;
  double most = 0;
  for (std::size_t i = 0; i < annotations.size(); ++i) {
    const double excess = std::min(by_planes[i], by_disc[i]);
    if (excess > most) {
      most = excess;
      worst = i;
    }
  }
  if (most <= 1) return std::nullopt;
  return worst;
}

std::string line(const char* format, double a, double b) {
  char text[200];
  std::snprintf(text, sizeof text, format, a, b);
  return text;
}

double squares_of(const SizeResiduals& width, const SizeResiduals& height) {
  return width.rms_px * width.rms_px + height.rms_px * height.rms_px;
}

bool is_plausible(const DiscModel& disc) {
  return disc.has_perspective() && disc.thickness <= kThickestOfWidth &&
         disc.tilt_deg() > kLeastTilt_deg && disc.tilt_deg() < kMostTilt_deg;
}

PuckSizeModel best_of(const SizeFit& planes, const DiscFit& disc, std::size_t rows) {
  PuckSizeModel model = planes.model;
  if (rows >= kFewestForDisc && is_plausible(disc.model) &&
      squares_of(disc.width, disc.height) <= squares_of(planes.width, planes.height)) {
    model.disc = disc.model;
  }
  return model;
}

void warn_of_coverage(SizeCalibration& calibration, SensorSize sensor) {
  if (sensor == SensorSize{}) return;
  const double share_x = (calibration.to.x - calibration.from.x) / sensor.width;
  const double share_y = (calibration.to.y - calibration.from.y) / sensor.height;
  if (share_x < kLeastCoverage || share_y < kLeastCoverage) {
    calibration.warnings.push_back(
        line("the centres span only %.0f %% of the image's width and %.0f %% of its height: "
             "elsewhere sizes are extrapolated",
             100 * share_x, 100 * share_y));
  }
  for (std::string& doubt : doubts_about(calibration.model, sensor)) {
    calibration.warnings.push_back(std::move(doubt));
  }
}

void warn_of_shape(SizeCalibration& calibration, std::span<const Annotation> annotations) {
  const auto tall = std::count_if(annotations.begin(), annotations.end(), [](const Annotation& a) {
    return a.size.height > kHighestOfWidth * a.size.width;
  });
  if (2 * static_cast<std::size_t>(tall) > annotations.size()) {
    calibration.warnings.push_back(
        "most of the annotations are higher than wide, as a puck on a table never is: are width "
        "and height swapped?");
  }
}

void check_inside(std::span<const Annotation> annotations, SensorSize sensor) {
  if (sensor == SensorSize{}) return;
  for (std::size_t i = 0; i < annotations.size(); ++i) {
    const Pixel centre = annotations[i].centre;
    if (centre.x >= 0 && centre.y >= 0 && centre.x <= sensor.width - 1 &&
        centre.y <= sensor.height - 1) {
      continue;
    }
    throw std::invalid_argument("annotation " + std::to_string(i + 1) +
                                line(" has its centre at (%.1f, %.1f)", centre.x, centre.y) +
                                ", outside the sensor of " + std::to_string(sensor.width) + "x" +
                                std::to_string(sensor.height) + " px");
  }
}

}  // namespace

SizeCalibration calibrate_size(std::span<const Annotation> annotations, SensorSize sensor) {
  check_inside(annotations, sensor);
  std::vector<NumberedAnnotation> kept;
  for (const Annotation& annotation : annotations) kept.push_back({kept.size() + 1, annotation});
  const auto fit_kept = [&] {
    const std::vector<Annotation> rows = without_rows(kept);
    Pixel middle{(sensor.width - 1) / 2.0, (sensor.height - 1) / 2.0};
    if (sensor == SensorSize{}) {
      const auto [left, right] = std::minmax_element(
          rows.begin(), rows.end(),
          [](const Annotation& a, const Annotation& b) { return a.centre.x < b.centre.x; });
      const auto [top, bottom] = std::minmax_element(
          rows.begin(), rows.end(),
          [](const Annotation& a, const Annotation& b) { return a.centre.y < b.centre.y; });
      middle = {(left->centre.x + right->centre.x) / 2, (top->centre.y + bottom->centre.y) / 2};
    }
    SizeFit planes = fit_puck_size_model(rows);
    return Fits{planes, fit_disc_model(rows, middle)};
  };

  Fits fits = fit_kept();
  std::vector<NumberedAnnotation> left_out;
  while (kept.size() >= kFewestForOutliers && 4 * (kept.size() - 1) >= 3 * annotations.size()) {
    const auto worst = worst_outlier(without_rows(kept), fits);
    if (!worst) break;
    const auto place = kept.begin() + static_cast<std::ptrdiff_t>(*worst);
    left_out.push_back(*place);
    kept.erase(place);
    fits = fit_kept();
  }

  fits.planes.model.sensor = sensor;
  SizeCalibration calibration{
      best_of(fits.planes, fits.disc, kept.size()), fits.planes, fits.disc, {}, {}, {}, {}};
  for (const NumberedAnnotation& n : left_out) {
    calibration.outliers.push_back(
        {n.row, n.annotation, fits.planes.model.extrapolated_at(n.annotation.centre)});
  }
  const std::vector<Annotation> used = without_rows(kept);
  calibration.from = calibration.to = used.front().centre;
  for (const Annotation& a : used) {
    calibration.from = {std::min(calibration.from.x, a.centre.x),
                        std::min(calibration.from.y, a.centre.y)};
    calibration.to = {std::max(calibration.to.x, a.centre.x),
                      std::max(calibration.to.y, a.centre.y)};
  }
  warn_of_shape(calibration, used);
  warn_of_coverage(calibration, sensor);
  return calibration;
}

}  // namespace puck
