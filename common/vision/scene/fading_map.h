#pragma once

#include <cstdint>

#include "common/events/sensor_size.h"
#include "common/vision/geometry/image.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// A decaying event map: events, each spread over 3 x 3 px, decay with a time constant of 1.5 s. It
/// shows what does not move, and is somewhat larger than the sensor's image.
class FadingMap {
 public:
  /// The map's value at a place, and its gradient along x and y, per px.
  struct Sample {
    double level = 0;
    double slope_x = 0;
    double slope_y = 0;
  };

  explicit FadingMap(SensorSize sensor);

  /// Sets the map to 0 everywhere.
  void clear();
  /// Notes the noise among the events added since the last call: mean events per pixel.
  void note_noise(double events);
  /// A level that the noted noise hardly ever exceeds at any pixel.
  double level_of_noise() const;

  /// Lets the map decay to `time_us`, not before the last time.
  void advance(std::int64_t time_us);

  /// Adds an event: 1 at its pixel, a half at its four neighbours, a quarter at the diagonal ones.
  /// Parts outside the map are dropped.
  void add(Pixel place);

  /// Prefetches the map at a place for `sample`: faster for many places at once than one by one.
  void fetch(Pixel place) const {
    const Pixel on_map = on_map_of(place, 0);
    if (!contains(on_map)) return;
    const float* here = map_.row(static_cast<int>(on_map.y)) + static_cast<int>(on_map.x);
    __builtin_prefetch(here);
    __builtin_prefetch(here + map_.width());
  }
  /// Interpolated between pixels; 0 outside the map.
  Sample sample(Pixel place) const {
    const Pixel on_map = on_map_of(place, 0);
    if (!contains(on_map)) return {};
    const int x = static_cast<int>(on_map.x);
    const int y = static_cast<int>(on_map.y);
    const double fx = on_map.x - x;
    const double fy = on_map.y - y;
    const float* above = map_.row(y) + x;
    const float* below = map_.row(y + 1) + x;
    const double top = above[0] + fx * (above[1] - above[0]);
    const double bottom = below[0] + fx * (below[1] - below[0]);
    return {unit_ * (top + fy * (bottom - top)),
            unit_ * ((1 - fy) * (above[1] - above[0]) + fy * (below[1] - below[0])),
            unit_ * (bottom - top)};
  }
  /// At the nearest pixel; 0 outside the map.
  double level(Pixel place) const {
    const Pixel on_map = on_map_of(place, kToNearest);
    if (!contains(on_map)) return 0;
    return unit_ * map_(static_cast<int>(on_map.x), static_cast<int>(on_map.y));
  }

 private:
  static constexpr double kToNearest = 0.5;

  // In map coordinates, so that truncation gives the pixel: the upper left one with `rounding` 0,
  // the nearest one with kToNearest.
  Pixel on_map_of(Pixel place, double rounding) const {
    return {place.x + margin_x_ + rounding, place.y + margin_y_ + rounding};
  }
  // False for NaN, too.
  bool contains(Pixel on_map) const {
    return on_map.x >= 1 && on_map.y >= 1 && on_map.x < map_.width() - 2 &&
           on_map.y < map_.height() - 2;
  }

  int margin_x_;
  int margin_y_;
  Image<float> map_;  // In units of unit_: new events grow instead of old ones decaying.
  double unit_ = 1;
  double noise_ = 0;  // of a pixel, fading
  double noise_variance_ = 0;
  std::int64_t time_us_ = 0;
};

}  // namespace puck
