#pragma once

#include <cstdint>

#include "common/events/sensor_size.h"
#include "common/vision/image.h"
#include "common/vision/pixel.h"

namespace puck {

/// Where events have been of late, each spread over 3 x 3 px and fading with 1.5 s: a picture of
/// what does not move, somewhat larger than the sensor's.
class FadingMap {
 public:
  /// What the map shows at a place, and how that changes from px to px along x and y.
  struct Sample {
    double level = 0;
    double slope_x = 0;
    double slope_y = 0;
  };

  explicit FadingMap(SensorSize sensor);

  /// Nothing has been anywhere.
  void clear();
  /// Notes that of what has been added since the last call each pixel has made so many events by
  /// itself, on average.
  void note_noise(double events);
  /// What the noise that was noted hardly ever exceeds anywhere.
  double level_of_noise() const;

  /// Moves on to `time_us`, not before the last.
  void advance(std::int64_t time_us);

  /// Adds an event: 1 at its own place, half of it beside and a quarter of it across. What lies
  /// outside the map is not kept.
  void add(Pixel place);

  /// Fetches what the map shows at a place, for `sample`: of many places, all at once, that takes
  /// less time than one by one.
  void fetch(Pixel place) const {
    const Pixel on_map = on_map_of(place, 0);
    if (!contains(on_map)) return;
    const float* here = map_.row(static_cast<int>(on_map.y)) + static_cast<int>(on_map.x);
    __builtin_prefetch(here);
    __builtin_prefetch(here + map_.width());
  }
  /// Between the pixels; nothing (0) outside the map.
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

  // On the map, so that cutting off the fractions gives its pixel: with `rounding` 0 the one to the
  // upper left, with kToNearest the nearest one.
  Pixel on_map_of(Pixel place, double rounding) const {
    return {place.x + margin_x_ + rounding, place.y + margin_y_ + rounding};
  }
  // False for what is no number, too.
  bool contains(Pixel on_map) const {
    return on_map.x >= 1 && on_map.y >= 1 && on_map.x < map_.width() - 2 &&
           on_map.y < map_.height() - 2;
  }

  int margin_x_;
  int margin_y_;
  Image<float> map_;  // In units of unit_: new events count for more, instead of old ones for less.
  double unit_ = 1;
  double noise_ = 0;  // of a pixel, fading
  double noise_variance_ = 0;
  std::int64_t time_us_ = 0;
};

}  // namespace puck
