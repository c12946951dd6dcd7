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

  /// Between the pixels; nothing (0) outside the map.
  Sample sample(Pixel place) const;
  /// At the nearest pixel.
  double level(Pixel place) const;

 private:
  bool contains(int x, int y) const {
    return x >= 1 && y >= 1 && x < map_.width() - 2 && y < map_.height() - 2;
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
