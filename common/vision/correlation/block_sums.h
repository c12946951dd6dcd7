#pragma once

#include <cstdint>
#include <vector>

#include "common/vision/geometry/image.h"

namespace puck {

/// Sums of a picture's grey over blocks of 8 × 8 pixels, for a cheap upper bound on the grey in a
/// rectangle. Every instruction set gives the same sums.
class BlockSums {
 public:
  static constexpr int kSide = 8;

  void set_picture(ImageView<const std::uint8_t> picture);

  /// Upper bound on the grey in any rectangle of width × height px, inside the picture or over its
  /// edge: the largest sum of the blocks that such a rectangle can touch.
  std::int64_t most_in(int width, int height);

  /// Upper bounds on the grey between two rows of the picture, the second one excluded, in each
  /// column of blocks. Valid until the next call.
  const std::vector<std::uint32_t>& columns_between(int first, int last);

 private:
  Image<std::uint32_t> sums_;
  Image<std::uint32_t> of_rows_;
  std::vector<std::uint32_t> of_columns_;
};

}  // namespace puck
