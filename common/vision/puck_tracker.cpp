#include "common/vision/puck_tracker.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

int odd(double value) { return 2 * static_cast<int>(std::floor(value / 2)) + 1; }

double gaussian(double distance, double sigma) {
  return std::exp(-0.5 * distance * distance / (sigma * sigma));
}

// Where the parabola through three neighbouring values peaks, from the middle one, −0.5 to 0.5.
double parabola_offset(double before, double middle, double after) {
  const double curvature = before - 2 * middle + after;
  if (!(curvature < 0)) return 0;
  return std::clamp(0.5 * (before - after) / curvature, -0.5, 0.5);
}

void quantise(Image<double>& values) {
  double lowest = values(0, 0);
  double highest = lowest;
  for (int y = 0; y < values.height(); ++y) {
    const auto [low, high] = std::minmax_element(values.row(y), values.row(y) + values.width());
    lowest = std::min(lowest, *low);
    highest = std::max(highest, *high);
  }
  const double scale = highest > lowest ? 255 / (highest - lowest) : 0;
  for (int y = 0; y < values.height(); ++y) {
    for (int x = 0; x < values.width(); ++x) {
      values(x, y) = std::nearbyint((values(x, y) - lowest) * scale);
    }
  }
}

}  // namespace

PuckTracker::PuckTracker(SensorSize sensor, const TrackerParams& params,
                         const PuckSizeModel& size_model, const ContourCalibration& calibration)
    : sensor_(sensor),
      params_(params),
      size_model_(size_model),
      ring_(sensor, params.ring, size_model, calibration) {
  const auto require_positive = [](const char* key, double value) {
    if (!(value > 0)) {
      throw std::invalid_argument(std::string(key) + " must be above 0, got " +
                                  std::to_string(value));
    }
  };
  require_positive("tracker.region_factor", params.region_factor);
  require_positive("tracker.prior_sigma", params.prior_sigma);
}

Region PuckTracker::region_around(Pixel position, const KernelBank& bank) const {
  const PuckSize size = bank.nominal(size_model_.at(position));
  return Region::around(position, odd(params_.region_factor * size.width),
                        odd(params_.region_factor * size.height))
      .intersect(Region::all_of(sensor_));
}

Region PuckTracker::first_region_at(Pixel position, const KernelBank& bank) const {
  if (params_.first_region.empty()) return region_around(position, bank);
  Region region = params_.first_region;
  region.x += static_cast<int>(std::lround(position.x));
  region.y += static_cast<int>(std::lround(position.y));
  return region.intersect(Region::all_of(sensor_));
}

PuckTracker::Step PuckTracker::step(Correlation& picture, const SurfaceSnapshot& surface,
                                    const Region& region, Pixel expected, const KernelBank& bank) {
  // Equation (2): the kernel's size follows from the place.
  const EllipseKernel& kernel = bank.nearest(size_model_.at(expected));
  const Region window = window_around(expected, kernel, region);
  Step result{expected, size_model_.at(expected), 0, std::nullopt};
  if (window.empty()) return result;

  // The convolution with the kernel.
  picture.correlate(kernel, params_.shift_to_lowest ? region : window, map_);
  // The Gaussian around the last position.
  weigh(window, params_.centred_window ? expected : window.centre(), kernel);
  if (params_.quantised) quantise(weighted_);

  // The restricted maximum: the first one in reading order.
  int best_x = 0;
  int best_y = 0;
  for (int y = 0; y < window.height; ++y) {
    for (int x = 0; x < window.width; ++x) {
      if (weighted_(x, y) > weighted_(best_x, best_y)) {
        best_x = x;
        best_y = y;
      }
    }
  }
  // Where nothing stands out the puck stays where it was expected.
  if (weighted_(best_x, best_y) > 0) {
    result.position = {static_cast<double>(window.x + best_x),
                       static_cast<double>(window.y + best_y)};
  }
  const int peak_x = static_cast<int>(std::lround(result.position.x));
  const int peak_y = static_cast<int>(std::lround(result.position.y));
  result.score = picture.contrast_at(kernel, peak_x, peak_y);

  if (params_.sub_pixel && weighted_(best_x, best_y) > 0) {
    const int x = peak_x - map_.region.x;
    const int y = peak_y - map_.region.y;
    const Image<double>& r = map_.response;
    if (x > 0 && x + 1 < r.width()) {
      result.position.x += parabola_offset(r(x - 1, y), r(x, y), r(x + 1, y));
    }
    if (y > 0 && y + 1 < r.height()) {
      result.position.y += parabola_offset(r(x, y - 1), r(x, y), r(x, y + 1));
    }
  }
  if (params_.ring.enabled) {
    const SoftRing::Fit fit = ring_.fit(surface.grey.view(), surface.region, result.position);
    result.position = fit.position;
    result.score = fit.score;
    result.spread_px = fit.spread_px;
    result.variance = measurement_variance(fit.peak, params_.noise);
  }
  result.size = size_model_.at(result.position);
  return result;
}

Region PuckTracker::window_around(Pixel expected, const EllipseKernel& kernel,
                                  const Region& region) const {
  const int x = static_cast<int>(std::lround(expected.x));
  const int y = static_cast<int>(std::lround(expected.y));
  const int before = params_.centred_window ? params_.reach_margin_px / 2 : 0;
  return Region{x - kernel.width() / 2 - before, y - kernel.height() / 2 - before,
                kernel.width() + params_.reach_margin_px, kernel.height() + params_.reach_margin_px}
      .intersect(region);
}

void PuckTracker::weigh(const Region& window, Pixel centre, const EllipseKernel& kernel) {
  double lowest = 0;
  if (params_.shift_to_lowest) {
    lowest = map_.response(0, 0);
    for (int y = 0; y < map_.region.height; ++y) {
      const double* row = map_.response.row(y);
      lowest = std::min(lowest, *std::min_element(row, row + map_.region.width));
    }
  }
  column_weight_.resize(static_cast<std::size_t>(window.width));
  for (int x = 0; x < window.width; ++x) {
    column_weight_[static_cast<std::size_t>(x)] =
        gaussian(window.x + x - centre.x, params_.prior_sigma * kernel.width());
  }
  weighted_.resize(window.width, window.height);
  for (int y = 0; y < window.height; ++y) {
    const double row_weight =
        gaussian(window.y + y - centre.y, params_.prior_sigma * kernel.height());
    const double* response =
        map_.response.row(window.y + y - map_.region.y) + (window.x - map_.region.x);
    for (int x = 0; x < window.width; ++x) {
      weighted_(x, y) = std::max(0.0, response[x] - lowest) * row_weight *
                        column_weight_[static_cast<std::size_t>(x)];
    }
  }
}

}  // namespace puck
