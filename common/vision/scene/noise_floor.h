#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "common/events/sensor_size.h"
#include "common/vision/scene/image_cells.h"

namespace puck {

/// Measures how many events the sensor's pixels make by themselves: as many as in the quietest
/// parts of the image. While the head turns even those may be busy, so that more noise is believed
/// slowly, less of it soon. The same events give the same answers, to the bit. One thread at a
/// time.
class NoiseFloor {
 public:
  explicit NoiseFloor(SensorSize sensor);

  /// Takes an event of anywhere in the image.
  void take(int x, int y) { ++counts_[cells_.cell_of(x, y)]; }

  /// To be called at each decision. Of times without decisions, and of a moment after them, nothing
  /// is learned.
  void decide(std::int64_t time_us);

  /// Events of a pixel in a µs; 0 while it is not known.
  double per_pixel_us() const { return rate_; }

  /// For how long, until the last decision, noise has explained all events in every part of the
  /// image, µs.
  std::int64_t quiet_us() const { return decided_us_ - active_us_; }

 private:
  void learn();
  bool is_explained() const;

  double pixels_a_cell_;
  ImageCells cells_;
  std::array<int, ImageCells::kCount> counts_{};
  std::int64_t decided_us_ = std::numeric_limits<std::int64_t>::min() / 2;
  std::int64_t counted_us_ = 0;  // below 0: not to be counted yet
  std::int64_t active_us_ = 0;   // when more happened last
  double rate_ = 0;
  bool is_known_ = false;
};

}  // namespace puck
