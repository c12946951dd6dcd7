#include "common/vision/correlation/weighted_peak.h"

#include <algorithm>
#include <cmath>

// Everything in this file is compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "common/vision/correlation/weighted_peak.cpp"
#include "hwy/foreach_target.h"
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace puck::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The highest and, with kLows, the lowest weighted response of each row. Products are not added to
// anything, so every instruction set rounds alike.
template <bool kLows>
void find_row_extremes(ImageView<const double> response, double lowest, const double* columns,
                       const double* rows, double* highs, double* lows) {
  const auto look = [&](auto d) HWY_ATTR {
    const int lanes = static_cast<int>(hn::Lanes(d));
    const int last = response.width() - lanes;
    const auto zero = hn::Zero(d);
    const auto shift = hn::Set(d, lowest);
    for (int y = 0; y < response.height(); ++y) {
      const double* row = response.row(y);
      const auto row_weight = hn::Set(d, rows[y]);
      auto high = zero;
      auto low = hn::Set(d, HUGE_VAL);
      // The last vector may overlap the one before it.
      for (int next = 0; next < response.width(); next += lanes) {
        const int x = std::min(next, last);
        const auto shifted = hn::Max(zero, hn::Sub(hn::LoadU(d, row + x), shift));
        const auto weighted = hn::Mul(hn::Mul(shifted, row_weight), hn::LoadU(d, columns + x));
        high = hn::Max(high, weighted);
        if constexpr (kLows) low = hn::Min(low, weighted);
      }
      highs[y] = hn::GetLane(hn::MaxOfLanes(d, high));
      if constexpr (kLows) lows[y] = hn::GetLane(hn::MinOfLanes(d, low));
    }
  };
  const hn::ScalableTag<double> wide;
  if (response.width() >= static_cast<int>(hn::Lanes(wide))) {
    look(wide);
  } else {
    look(hn::CappedTag<double, 1>());
  }
}

void find_row_highs(ImageView<const double> response, double lowest, const double* columns,
                    const double* rows, double* highs) {
  find_row_extremes<false>(response, lowest, columns, rows, highs, nullptr);
}

void find_row_highs_and_lows(ImageView<const double> response, double lowest, const double* columns,
                             const double* rows, double* highs, double* lows) {
  find_row_extremes<true>(response, lowest, columns, rows, highs, lows);
}

}  // namespace puck::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace puck {
namespace {

HWY_EXPORT(find_row_highs);
HWY_EXPORT(find_row_highs_and_lows);

constexpr double kHighestLevel = 255;

}  // namespace

const std::vector<double>& GaussianTable::at(double first, int count, double sigma) {
  const auto size = static_cast<std::size_t>(count);
  if (first == first_ && sigma == sigma_ && size == values_.size()) return values_;
  first_ = first;
  sigma_ = sigma;
  values_.resize(size);
  for (int i = 0; i < count; ++i) {
    const double distance = first + i;
    values_[static_cast<std::size_t>(i)] = std::exp(-0.5 * distance * distance / (sigma * sigma));
  }
  return values_;
}

WeightedPeak WeightedPeakFinder::find(const WeightedWindow& window, double lowest) {
  return look(window, lowest).peak;
}

std::optional<WeightedPeak> WeightedPeakFinder::find_between(const WeightedWindow& window,
                                                             double least, double most) {
  const Found a = look(window, most);
  const Found b = look(window, least);
  if (!a.peak.stands_out || a.peak.x != b.peak.x || a.peak.y != b.peak.y) return std::nullopt;
  if (!window.quantised) return a.peak;
  // Height above the highest level's lower end is convex in the lowest response, as the window's
  // minimum is concave: a pixel below it at both ends is below it between. The peak must be above
  // it even with a single pixel, never below the minimum, in the minimum's place.
  if (!(a.highest == b.highest)) return std::nullopt;
  for (const double lowest : {least, most}) {
    if (!reaches_highest_level(weighted(window, {a.peak.x, a.peak.y}, lowest),
                               weighted(window, b.lowest, lowest),
                               weighted(window, a.highest, lowest))) {
      return std::nullopt;
    }
  }
  return a.peak;
}

WeightedPeakFinder::Found WeightedPeakFinder::look(const WeightedWindow& window, double lowest) {
  const double* columns = window.columns->data();
  const double* rows = window.rows->data();
  row_highs_.resize(window.rows->size());
  double low = 0;
  if (window.quantised) {
    row_lows_.resize(window.rows->size());
    HWY_DYNAMIC_DISPATCH(find_row_highs_and_lows)
    (window.response, lowest, columns, rows, row_highs_.data(), row_lows_.data());
    low = *std::min_element(row_lows_.begin(), row_lows_.end());
  } else {
    HWY_DYNAMIC_DISPATCH(find_row_highs)
    (window.response, lowest, columns, rows, row_highs_.data());
  }
  const double high = *std::max_element(row_highs_.begin(), row_highs_.end());
  Found found;
  if (!(high > low)) return found;
  found.highest = place_of(window, lowest, high, row_highs_);
  Place peak = found.highest;
  if (window.quantised) {
    found.lowest = place_of(window, lowest, low, row_lows_);
    // The first of all places on the highest level counts.
    const auto row = std::find_if(row_highs_.begin(), row_highs_.end(), [&](double value) {
      return reaches_highest_level(value, low, high);
    });
    peak = {0, static_cast<int>(row - row_highs_.begin())};
    while (peak.x + 1 < window.response.width() &&
           !reaches_highest_level(weighted(window, peak, lowest), low, high)) {
      ++peak.x;
    }
  }
  found.peak = {peak.x, peak.y, true};
  return found;
}

double WeightedPeakFinder::weighted(const WeightedWindow& window, Place place, double lowest) {
  return std::max(0.0, window.response(place.x, place.y) - lowest) *
         (*window.rows)[static_cast<std::size_t>(place.y)] *
         (*window.columns)[static_cast<std::size_t>(place.x)];
}

// The first place with a value that is its row's highest or lowest.
WeightedPeakFinder::Place WeightedPeakFinder::place_of(const WeightedWindow& window, double lowest,
                                                       double value,
                                                       const std::vector<double>& of_rows) {
  const auto row = std::find(of_rows.begin(), of_rows.end(), value);
  Place place{0, static_cast<int>(row - of_rows.begin())};
  while (place.x + 1 < window.response.width() && weighted(window, place, lowest) != value) {
    ++place.x;
  }
  return place;
}

bool WeightedPeakFinder::reaches_highest_level(double value, double low, double high) {
  return std::nearbyint((value - low) * (kHighestLevel / (high - low))) >= kHighestLevel;
}

}  // namespace puck
#endif
