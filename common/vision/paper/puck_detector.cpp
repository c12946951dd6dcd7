#include "common/vision/paper/puck_detector.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace puck {
namespace {

// Step between the rows of a search with a kernel for each row; refined() correlates the omitted
// rows around each peak.
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

bool better(const PuckDetector::Detection& a, const PuckDetector::Detection& b) {
  return a.response > b.response;
}

}  // namespace

Region detection_region(SensorSize sensor, const DetectorParams& params) {
  const Region all = Region::all_of(sensor);
  if (params.region.empty()) return all;
  const Region inside = params.region.intersect(all);
  if (inside.empty()) {
    throw std::invalid_argument("tracker.detection_region lies outside the sensor");
  }
  return inside;
}

PuckDetector::PuckDetector(const DetectorParams& params, const PuckSizeModel& size_model)
    : params_(params),
      size_model_(size_model),
      fixed_kernel_(fixed_geometry(params.fixed_height_px), params.fixed_profile) {
  found_.reserve(kMostDetections);
}

const std::vector<PuckDetector::Detection>& PuckDetector::detect(Correlation& picture,
                                                                 const Region& where,
                                                                 const KernelBank& bank) {
  found_.clear();
  if (where.empty()) return found_;
  switch (params_.kernel) {
    case DetectionKernel::kFixed:
      find_best(picture, fixed_kernel_, where);
      break;
    case DetectionKernel::kSizeAtCentre:
      find_best(picture, bank.nearest(size_model_.at(where.centre())), where);
      break;
    case DetectionKernel::kSizePerRow:
      find_peaks(picture, where, bank);
      break;
  }
  return found_;
}

void PuckDetector::find_best(Correlation& picture, const EllipseKernel& kernel,
                             const Region& where) {
  picture.correlate(kernel, where, map_);
  Detection best{{}, params_.threshold};
  for (int y = 0; y < where.height; ++y) {
    const double* row = map_.response.row(y);
    for (int x = 0; x < where.width; ++x) {
      if (row[x] > best.response) {
        best = {{static_cast<double>(where.x + x), static_cast<double>(where.y + y)}, row[x]};
      }
    }
  }
  if (best.response > params_.threshold) found_.push_back(best);
}

void PuckDetector::find_peaks(Correlation& picture, const Region& where, const KernelBank& bank) {
  responses_.resize(where.width, (where.height + kRowStep - 1) / kRowStep);
  parts_.clear();
  // Once, for any number of parts: dark blocks lie between them.
  constexpr int kLeastApart = 2 * BlockSums::kSide;
  parts_.reserve(static_cast<std::size_t>(responses_.height() * (where.width / kLeastApart + 1)));
  picture.cover(where.inflated(bank.reach_beyond(where, size_model_)));
  for (int row = 0; row < responses_.height(); ++row) {
    const Region line{where.x, where.y + row * kRowStep, where.width, 1};
    const EllipseKernel& kernel = bank.nearest(size_model_.at(line.centre()));
    float* responses = responses_.row(row);
    // Where all is dark the response is 0, which no threshold admits.
    std::fill_n(responses, where.width, -std::numeric_limits<float>::infinity());
    picture.for_each_bright_part(kernel, line, [&](const Region& part) {
      parts_.push_back(part);
      picture.correlate(kernel, part, map_);
      std::copy_n(map_.response.row(0), part.width, responses + (part.x - where.x));
    });
  }
  collect_peaks(where);
  keep_best_apart();
  for (Detection& peak : found_) peak = refined(picture, where, bank, peak);
  std::stable_sort(found_.begin(), found_.end(), better);
}

// Of equal neighbours the first counts, so that a plateau is one peak.
void PuckDetector::collect_peaks(const Region& where) {
  peaks_.clear();
  const auto threshold = static_cast<float>(params_.threshold);
  for (const Region& part : parts_) {
    const int y = (part.y - where.y) / kRowStep;
    for (int x = part.x - where.x; x < part.right() - where.x; ++x) {
      const float response = responses_(x, y);
      if (!(response > threshold)) continue;
      bool highest = true;
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (x + dx < 0 || x + dx >= where.width || y + dy < 0 || y + dy >= responses_.height()) {
            continue;
          }
          const float neighbour = responses_(x + dx, y + dy);
          const bool before = dy < 0 || (dy == 0 && dx < 0);
          if (neighbour > response || (before && neighbour == response)) highest = false;
        }
      }
      if (!highest) continue;
      peaks_.push_back(
          {{static_cast<double>(where.x + x), static_cast<double>(where.y + y * kRowStep)},
           response});
    }
  }
}

void PuckDetector::keep_best_apart() {
  std::stable_sort(peaks_.begin(), peaks_.end(), better);
  for (const Detection& peak : peaks_) {
    if (found_.size() == kMostDetections) return;
    const bool apart = std::none_of(found_.begin(), found_.end(), [&](const Detection& taken) {
      const PuckSize size = size_model_.at(taken.position);
      return std::abs(peak.position.x - taken.position.x) < size.width / 2 &&
             std::abs(peak.position.y - taken.position.y) < size.height / 2;
    });
    if (apart) found_.push_back(peak);
  }
}

// Correlates the rows around the peak that the search has left out, too.
PuckDetector::Detection PuckDetector::refined(Correlation& picture, const Region& where,
                                              const KernelBank& bank, Detection peak) {
  Detection best{peak.position, -std::numeric_limits<double>::infinity()};
  const Region around = Region::around(peak.position, 2 * kRowStep - 1, 2 * kRowStep - 1);
  const Region rows = around.intersect(where);
  for (int y = rows.y; y < rows.bottom(); ++y) {
    const Region line{where.x, y, where.width, 1};
    const EllipseKernel& kernel = bank.nearest(size_model_.at(line.centre()));
    picture.correlate(kernel, {rows.x, y, rows.width, 1}, map_);
    for (int x = 0; x < rows.width; ++x) {
      const double response = map_.response(x, 0);
      if (response > best.response) {
        best = {{static_cast<double>(rows.x + x), static_cast<double>(y)}, response};
      }
    }
  }
  return best;
}

}  // namespace puck
