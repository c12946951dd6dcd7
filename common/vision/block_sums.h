#pragma once

#include <cstdint>
#include <vector>

#include "common/vision/image.h"

namespace puck {

/// A picture's grey summed up in blocks of 8 × 8 pixels: says cheaply how bright a rectangle of it
/// can be at most. Every instruction set gives the same sums.
class BlockSums {
 public:
  static constexpr int kSide = 8;

  void set_picture(ImageView<const std::uint8_t> picture);

  /// No rectangle of width × height px, wherever it lies in the picture or over its edge, has more
  /// grey than this. It is the sum of blocks that a rectangle can touch, so it is larger than what
  /// the brightest one has.
  std::int64_t most_in(int width, int height);

 private:
  Image<std::uint32_t> sums_;
  Image<std::uint32_t> of_rows_;
  std::vector<std::uint32_t> of_columns_;
};

}  // namespace puck
