#pragma once

#include <cstdint>

#include "common/vision/image.h"

namespace puck {

/// Smooths a surface before it is correlated: 5×5 Gaussian, sigma about 1.1 px, in 8-bit fixed
/// point; at the border of what it is given the picture is mirrored about its outermost pixels. The
/// same result as OpenCV's GaussianBlur(…, Size(5, 5), 0), which the authors' code calls.
class GaussianBlur {
 public:
  /// How far a pixel's value reaches.
  static constexpr int kRadius = 2;

  /// Blurs all of `source` into `out`, which takes its size.
  void apply(ImageView<const std::uint8_t> source, Image<std::uint8_t>& out);

 private:
  Image<std::uint16_t> rows_;         // blurred along x, 8.8 fixed point
  Image<std::uint8_t> mirrored_row_;  // one row with its mirrored ends
};

}  // namespace puck
