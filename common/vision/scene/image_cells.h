#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/events/sensor_size.h"

namespace puck {

/// A grid of 8 × 6 cells over the image, for counting events.
class ImageCells {
 public:
  static constexpr std::size_t kColumns = 8;
  static constexpr std::size_t kRows = 6;
  static constexpr std::size_t kCount = kColumns * kRows;

  explicit ImageCells(SensorSize sensor) {
    const auto width = static_cast<std::size_t>(sensor.width);
    const auto height = static_cast<std::size_t>(sensor.height);
    for (std::size_t x = 0; x < width; ++x) {
      column_of_.push_back(static_cast<std::uint8_t>(x * kColumns / width));
    }
    for (std::size_t y = 0; y < height; ++y) {
      first_of_row_.push_back(static_cast<std::uint8_t>(y * kRows / height * kColumns));
    }
  }

  /// Cell of a pixel of the image, 0 to kCount − 1.
  std::size_t cell_of(int x, int y) const {
    return std::size_t{column_of_[static_cast<std::size_t>(x)]} +
           first_of_row_[static_cast<std::size_t>(y)];
  }

 private:
  // A table instead of a division, for every event.
  std::vector<std::uint8_t> column_of_;
  std::vector<std::uint8_t> first_of_row_;
};

}  // namespace puck
