#pragma once

#include <cmath>
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
    const Place at = place_of(place, 0);
    if (!contains(at)) return;
    __builtin_prefetch(map_.row(at.y) + at.x);
    __builtin_prefetch(map_.row(at.y + 1) + at.x);
  }
  /// Between the pixels; nothing (0) outside the map.
  Sample sample(Pixel place) const {
    const Place at = place_of(place, 0);
    if (!contains(at)) return {};
    const double fx = place.x + margin_x_ - at.x;
    const double fy = place.y + margin_y_ - at.y;
    const float* above = map_.row(at.y) + at.x;
    const float* below = map_.row(at.y + 1) + at.x;
    const double top = above[0] + fx * (above[1] - above[0]);
    const double bottom = below[0] + fx * (below[1] - below[0]);
    return {unit_ * (top + fy * (bottom - top)),
            unit_ * ((1 - fy) * (above[1] - above[0]) + fy * (below[1] - below[0])),
            unit_ * (bottom - top)};
  }
  /// At the nearest pixel; 0 outside the map.
  double level(Pixel place) const {
    const Place at = place_of(place, 0.5);
    return contains(at) ? unit_ * map_(at.x, at.y) : 0;
  }

 private:
  // A pixel of the map.
  struct Place {
    int x;
    int y;
  };

  // The pixel in which a place lies, `middle` of the way between it and the next. What lies beyond
  // the left or upper border may come to lie on it.
  Place place_of(Pixel place, double middle) const {
    return {static_cast<int>(place.x + margin_x_ + middle),
            static_cast<int>(place.y + margin_y_ + middle)};
  }
  // … and is not taken for the map's: its border has no events.
  bool contains(Place at) const {
    return at.x >= 1 && at.y >= 1 && at.x < map_.width() - 2 && at.y < map_.height() - 2;
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
