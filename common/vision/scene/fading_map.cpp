#include "common/vision/scene/fading_map.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr double kFading_us = 1'500'000;
// The unit is reset to 1 long before floats run out of range.
constexpr double kSmallestUnit = 1e-6;
// Sums of the weights of one event over all its pixels, and of their squares.
constexpr double kWeights = 4;
constexpr double kSquares = 2.25;
constexpr double kSigmas = 4;

}  // namespace

FadingMap::FadingMap(SensorSize sensor)
    : margin_x_(sensor.width / 4),
      margin_y_(sensor.height / 4),
      map_(sensor.width + 2 * margin_x_, sensor.height + 2 * margin_y_) {}

void FadingMap::note_noise(double events) {
  noise_ += events;
  noise_variance_ += events;
}

double FadingMap::level_of_noise() const {
  return kWeights * noise_ + kSigmas * std::sqrt(kSquares * noise_variance_);
}

void FadingMap::clear() {
  for (int y = 0; y < map_.height(); ++y) std::fill_n(map_.row(y), map_.width(), 0.0F);
  noise_ = 0;
  noise_variance_ = 0;
}

void FadingMap::advance(std::int64_t time_us) {
  const double keep = std::exp(-static_cast<double>(time_us - time_us_) / kFading_us);
  unit_ *= keep;
  noise_ *= keep;
  noise_variance_ *= keep * keep;
  time_us_ = time_us;
  if (unit_ > kSmallestUnit) return;
  for (int y = 0; y < map_.height(); ++y) {
    float* row = map_.row(y);
    for (int x = 0; x < map_.width(); ++x) row[x] *= static_cast<float>(unit_);
  }
  unit_ = 1;
}

void FadingMap::add(Pixel place) {
  const Pixel on_map = on_map_of(place, kToNearest);
  if (!contains(on_map)) return;
  const int x = static_cast<int>(on_map.x);
  const int y = static_cast<int>(on_map.y);
  const auto peak = static_cast<float>(1 / unit_);
  for (int dy = -1; dy <= 1; ++dy) {
    float* row = map_.row(y + dy) + x;
    const float here = dy == 0 ? peak : peak / 2;
    row[-1] += here / 2;
    row[0] += here;
    row[1] += here / 2;
  }
}

}  // namespace puck
