#include "common/vision/paper/puck_tracker.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace puck {
namespace {

// Up to this size, correlating the region takes no longer than testing whether it is necessary.
constexpr int kFewCandidates = 2'000;

int odd(double value) { return 2 * static_cast<int>(std::floor(value / 2)) + 1; }

}  // namespace

PuckTracker::PuckTracker(SensorSize sensor, const TrackerParams& params,
                         const PuckSizeModel& size_model, std::optional<SoftRing> ring)
    : sensor_(sensor), params_(params), size_model_(size_model), ring_(std::move(ring)) {
  const auto require_positive = [](const char* key, double value) {
    if (!(value > 0)) {
      throw std::invalid_argument(std::string(key) + " must be above 0, got " +
                                  std::to_string(value));
    }
  };
  require_positive("tracker.region_factor", params.region_factor);
  require_positive("tracker.prior_sigma", params.prior_sigma);
}

Region PuckTracker::whole_region_around(Pixel position, const KernelBank& bank) const {
  const PuckSize size = bank.nominal(size_model_.at(position));
  return Region::around(position, std::min(odd(params_.region_factor * size.width), sensor_.width),
                        std::min(odd(params_.region_factor * size.height), sensor_.height));
}

Region PuckTracker::region_around(Pixel position, const KernelBank& bank) const {
  return whole_region_around(position, bank).intersect(Region::all_of(sensor_));
}

Region PuckTracker::first_region_at(Pixel position, const KernelBank& bank) const {
  if (params_.first_region.empty()) return region_around(position, bank);
  Region region = params_.first_region;
  region.x += static_cast<int>(std::lround(position.x));
  region.y += static_cast<int>(std::lround(position.y));
  return region.intersect(Region::all_of(sensor_));
}

PuckTracker::Step PuckTracker::step(const SurfaceSnapshot& surface, const Region& region,
                                    Pixel expected, const KernelBank& bank) {
  // The kernel's size follows from the place.
  const EllipseKernel& kernel = bank.nearest(size_model_.at(expected));
  const Region window = window_around(expected, kernel, region);
  Step result{expected, size_model_.at(expected), 0};
  if (window.empty()) return result;

  // The convolution with the kernel.
  picture_.set_surface(surface.grey.view(), surface.region);
  // The Gaussian around the last position, and the restricted maximum.
  const WeightedPeak peak =
      find_peak(kernel, region, window, params_.centred_window ? expected : window.centre());
  // Without a peak the puck stays at the expected position.
  if (peak.stands_out) {
    result.position = {static_cast<double>(window.x + peak.x),
                       static_cast<double>(window.y + peak.y)};
  }
  result.score = picture_.contrast_at(kernel, static_cast<int>(std::lround(result.position.x)),
                                      static_cast<int>(std::lround(result.position.y)));
  if (ring_) {
    const SoftRing::Fit fit = ring_->fit(surface.grey.view(), surface.region, result.position);
    result.position = fit.position;
    result.score = fit.score;
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

// The lowest response in the whole region, which shifts the others, needs several times as many
// candidates as the window has. Mostly, however, the maximum is the same for any value within its
// bounds.
WeightedPeak PuckTracker::find_peak(const EllipseKernel& kernel, const Region& region,
                                    const Region& window, Pixel centre) {
  if (!params_.shift_to_lowest) {
    picture_.correlate(kernel, window, map_);
    return finder_.find(weigh(window, centre, kernel), 0);
  }
  if (region.width * region.height <= kFewCandidates) {
    const double lowest = picture_.correlate_lowest(kernel, region, window, map_);
    return finder_.find(weigh(window, centre, kernel), lowest);
  }
  const double most = picture_.correlate_lowest(kernel, window, window, map_);
  const WeightedWindow weighted = weigh(window, centre, kernel);
  if (const auto peak = finder_.find_between(weighted, kernel.lowest_response(), most)) {
    return *peak;
  }
  if (const auto peak = finder_.find_between(weighted, picture_.lower_bound(kernel), most)) {
    return *peak;
  }
  const double lowest = picture_.correlate_lowest(kernel, region, window, map_);
  return finder_.find(weigh(window, centre, kernel), lowest);
}

WeightedWindow PuckTracker::weigh(const Region& window, Pixel centre, const EllipseKernel& kernel) {
  WeightedWindow weighted;
  weighted.response = map_.response.view().part(window.x - map_.region.x, window.y - map_.region.y,
                                                window.width, window.height);
  weighted.columns =
      &columns_.at(window.x - centre.x, window.width, params_.prior_sigma * kernel.width());
  weighted.rows =
      &rows_.at(window.y - centre.y, window.height, params_.prior_sigma * kernel.height());
  weighted.quantised = params_.quantised;
  return weighted;
}

}  // namespace puck
