#include "common/vision/puck_detector.h"

#include <limits>
#include <stdexcept>

namespace puck {
namespace {

// Rows between the candidates of a search with a kernel for each row; the rows that this leaves out
// are looked at around the best one.
constexpr int kRowStep = 2;

KernelGeometry fixed_geometry(int height_px) {
  if (height_px < 3) {
    throw std::invalid_argument("the fixed detection kernel must be at least 3 px high");
  }
  // The authors' canvas is truncated to whole pixels while the ellipse is not, so the anchor lies a
  // little up and left of the ellipse's centre.
  const double width_px = 1.6 * height_px;
  KernelGeometry geometry;
  geometry.canvas_width = static_cast<int>(width_px);
  geometry.canvas_height = height_px;
  geometry.origin_x = width_px / 2;
  geometry.origin_y = height_px / 2.0;
  geometry.semi_x = width_px / 2;
  geometry.semi_y = height_px / 2.0;
  geometry.anchor_x = geometry.canvas_width / 2;
  geometry.anchor_y = geometry.canvas_height / 2;
  return geometry;
}

Region detection_region(SensorSize sensor, const Region& wanted) {
  const Region all = Region::all_of(sensor);
  if (wanted.empty()) return all;
  const Region inside = wanted.intersect(all);
  if (inside.empty()) {
    throw std::invalid_argument("tracker.detection_region lies outside the sensor");
  }
  return inside;
}

}  // namespace

PuckDetector::PuckDetector(SensorSize sensor, const DetectorParams& params,
                           const PuckSizeModel& size_model)
    : params_(params),
      size_model_(size_model),
      region_(detection_region(sensor, params.region)),
      fixed_kernel_(fixed_geometry(params.fixed_height_px), params.fixed_profile) {}

std::optional<PuckDetector::Detection> PuckDetector::detect(Correlation& picture,
                                                            const Region& where,
                                                            const KernelBank& bank) {
  if (where.empty()) return std::nullopt;
  Detection best;
  switch (params_.kernel) {
    case DetectionKernel::kFixed:
      best = best_in(picture, fixed_kernel_, where);
      break;
    case DetectionKernel::kSizeAtCentre:
      best = best_in(picture, bank.nearest(size_model_.at(where.centre())), where);
      break;
    case DetectionKernel::kSizePerRow:
      best = best_by_rows(picture, where, bank);
      break;
  }
  if (!(best.response > params_.threshold)) return std::nullopt;
  return best;
}

PuckDetector::Detection PuckDetector::best_in(Correlation& picture, const EllipseKernel& kernel,
                                              const Region& where) {
  picture.correlate(kernel, where, map_);
  Detection best{{}, -std::numeric_limits<double>::infinity()};
  for (int y = 0; y < where.height; ++y) {
    const double* row = map_.response.row(y);
    for (int x = 0; x < where.width; ++x) {
      if (row[x] > best.response) {
        best = {{static_cast<double>(where.x + x), static_cast<double>(where.y + y)}, row[x]};
      }
    }
  }
  return best;
}

PuckDetector::Detection PuckDetector::best_by_rows(Correlation& picture, const Region& where,
                                                   const KernelBank& bank) {
  Detection best{{}, -std::numeric_limits<double>::infinity()};
  const auto look_at_row = [&](int y) {
    const Region row{where.x, y, where.width, 1};
    const Detection found = best_in(picture, bank.nearest(size_model_.at(row.centre())), row);
    if (found.response > best.response) best = found;
  };
  for (int y = where.y; y < where.bottom(); y += kRowStep) look_at_row(y);
  const int middle = static_cast<int>(best.position.y);
  for (int y = middle - kRowStep + 1; y < middle + kRowStep; ++y) {
    if (y != middle && where.contains(where.x, y)) look_at_row(y);
  }
  return best;
}

}  // namespace puck
