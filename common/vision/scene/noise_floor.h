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

  /// Takes an event of anywhere in the image. Returns its cell.
  std::size_t take(int x, int y) {
    const std::size_t cell = cells_.cell_of(x, y);
    ++counts_[cell];
    return cell;
  }

  /// To be called at each decision. Of times without decisions, and of a moment after them, nothing
  /// is learned.
  void decide(std::int64_t time_us);

  /// Events of a pixel in a µs; 0 while it is not known.
  double per_pixel_us() const { return rate_; }
  double per_cell_us() const { return rate_ * pixels_a_cell_; }

 private:
  void learn();

  double pixels_a_cell_;
  ImageCells cells_;
  std::array<int, ImageCells::kCount> counts_{};
  std::int64_t decided_us_ = std::numeric_limits<std::int64_t>::min() / 2;
  std::int64_t counted_us_ = 0;  // below 0: not to be counted yet
  double rate_ = 0;
  bool is_known_ = false;
};

}  // namespace puck
