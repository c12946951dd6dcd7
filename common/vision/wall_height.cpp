#include "common/vision/wall_height.h"

#include <algorithm>
#include <numeric>

namespace puck {
namespace {

// What is known fades while the puck is watched.
constexpr double kHeightMemory_us = 1'000'000;
// Only an edge that moves across itself makes events, and in a small image the edges are one.
constexpr double kLeastAcross_px_s = 100;
constexpr double kLeastWidth_px = 16;
// From the middle of an edge, in half axes: farther off, edges run into one another.
constexpr double kMiddle = 0.5;
// A puck's wall, in widths. What lies nearer to the face is its own edge, blurred.
constexpr double kLowest = 0.1;
constexpr double kHighest = kHighestWall - 0.05;
// The wall's edge has so many events, each so many bins from its middle at most, and so many times
// more than there are elsewhere.
constexpr double kEnoughOfEdge = 60;
constexpr std::size_t kReach = 3;
constexpr double kClear = 2;

}  // namespace

void WallHeight::watch(const ContourTrack* puck, const PuckContour& contour,
                       std::int64_t passed_us) {
  is_watching_ = false;
  if (!puck) return;
  const ContourFilter& filter = puck->filter();
  position_ = filter.position();
  velocity_ = filter.velocity();
  time_us_ = filter.time_us();
  growth_px_ = filter.growth_px();
  width_px_ = contour.size_at(position_).width;
  if (width_px_ < kLeastWidth_px) return;
  is_watching_ = true;
  face_ = contour.ring_at(position_, 0);
  profile_ = contour.wall_profile(position_);
  behind_px_ = {contour.behind_px(velocity_.x), contour.behind_px(velocity_.y)};
  const double keep = std::exp(-static_cast<double>(passed_us) / kHeightMemory_us);
  for (double& count : counts_) count *= keep;
  upper_.fade(keep);
  sides_.fade(keep);
}

void WallHeight::compare(const ContourEvent& event) {
  const double dt = static_cast<double>(event.time_us - time_us_) * 1e-6;
  const double dx = event.x - (position_.x + dt * velocity_.x);
  const double dy = event.y - (position_.y + dt * velocity_.y);
  if (std::abs(dx) > width_px_ || std::abs(dy) > width_px_) return;
  const double slant = face_.shear * std::clamp(dy, -face_.semi_y, face_.semi_y);
  const double u = (dx - slant) / face_.semi_x;
  // Grown by `g` all round, and `b` above the track, the puck has its upper edge g + b outside the
  // model's, the lower one g − b.
  const double growth_px = sides_.mean_px(growth_px_);
  const double low_px = upper_.mean_px(growth_px_) - growth_px;
  const double v = (dy + low_px) / face_.semi_y;
  if (std::abs(u) > kMiddle) {
    // Below its middle the face's side is the wall's as well.
    if (v > -kMiddle && v < 0 && std::abs(velocity_.x) > kLeastAcross_px_s) {
      sides_.add((std::abs(u) - std::sqrt(1 - v * v)) * face_.semi_x +
                 (u > 0 ? behind_px_.x : -behind_px_.x));
    }
    return;
  }
  if (std::abs(velocity_.y) < kLeastAcross_px_s) return;
  const double r = std::sqrt(1 - u * u);
  if (dy < 0) {
    upper_.add(-dy - r * face_.semi_y - behind_px_.y);
    return;
  }
  const double beyond_px = (v - r) * face_.semi_y + behind_px_.y - growth_px;
  const double share = beyond_px / (2 * face_.semi_x) / profile_;
  if (share >= kFirst && share < kFirst + kBin * static_cast<double>(kBins)) {
    counts_[std::min(bin_of(share), kBins - 1)] += 1;
  }
}

double WallHeight::count_around(std::size_t bin) const {
  const auto middle = counts_.begin() + static_cast<std::ptrdiff_t>(bin);
  constexpr auto kAside = static_cast<std::ptrdiff_t>(kReach);
  return std::accumulate(middle - kAside, middle + kAside + 1, 0.0);
}

std::optional<double> WallHeight::share() const {
  const std::size_t first = bin_of(kLowest);
  std::size_t edge = first;
  double count = count_around(edge);
  for (std::size_t bin = first + 1; bin <= bin_of(kHighest); ++bin) {
    const double here = count_around(bin);
    if (here <= count) continue;
    edge = bin;
    count = here;
  }
  // The most at the lowest height are those of the face's own edge, blurred.
  if (edge == first || count < kEnoughOfEdge) return std::nullopt;
  double moment = 0;
  double elsewhere = 0;
  double bins_elsewhere = 0;
  for (std::size_t bin = first - kReach; bin < kBins; ++bin) {
    const std::size_t apart = std::max(bin, edge) - std::min(bin, edge);
    if (apart <= kReach) {
      moment += counts_[bin] * (kFirst + kBin * (static_cast<double>(bin) + 0.5));
    } else if (bin >= first && apart > 2 * kReach) {
      elsewhere += counts_[bin];
      bins_elsewhere += 1;
    }
  }
  if (count * bins_elsewhere < kClear * elsewhere * (2 * kReach + 1)) return std::nullopt;
  return moment / count;
}

}  // namespace puck
