#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/events/sensor_size.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// The cells of 8 × 8 px of the image near which something is followed: most events are rejected
/// by one look here instead of one for each hypothesis.
class NearCells {
 public:
  explicit NearCells(SensorSize sensor)
      : sensor_(sensor),
        columns_((sensor.width + kSide - 1) / kSide),
        cells_(static_cast<std::size_t>(columns_) *
               static_cast<std::size_t>((sensor.height + kSide - 1) / kSide)) {}

  void clear() { std::fill(cells_.begin(), cells_.end(), std::uint8_t{0}); }

  /// Adds all cells that a region touches.
  void add(const Region& region) {
    const Region inside = region.intersect(Region::all_of(sensor_));
    if (inside.empty()) return;
    const int first = inside.x / kSide;
    const int count = (inside.right() - 1) / kSide - first + 1;
    for (int row = inside.y / kSide; row <= (inside.bottom() - 1) / kSide; ++row) {
      std::fill_n(cells_.begin() + row * columns_ + first, count, std::uint8_t{1});
    }
  }

  /// Whether the cell of a pixel of the image has been added.
  bool contains(int x, int y) const {
    return cells_[static_cast<std::size_t>(y / kSide * columns_ + x / kSide)] != 0;
  }

 private:
  static constexpr int kSide = 8;

  SensorSize sensor_;
  int columns_;
  std::vector<std::uint8_t> cells_;
};

}  // namespace puck
