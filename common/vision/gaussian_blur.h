#pragma once

#include <cstdint>
#include <vector>

#include "common/vision/image.h"
#include "common/vision/region.h"

namespace puck {

/// Smooths a surface before it is correlated: 5×5 Gaussian, sigma about 1.1 px, in 8-bit fixed
/// point; at the border of what it is given the picture is mirrored about its outermost pixels. The
/// same result as OpenCV's GaussianBlur(…, Size(5, 5), 0), which the authors' code calls. Every
/// instruction set gives the same bytes.
class GaussianBlur {
 public:
  /// How far a pixel's value reaches.
  static constexpr int kRadius = 2;
  /// What is mirrored counts more than once, but no pixel of a picture larger than 4 × 4 px adds
  /// more than so many times its grey to the result, rounding aside: 20 of 16ths in each direction.
  static constexpr double kMostGain = 1.25 * 1.25;

  /// Blurs all of `source` into `out`, which takes its size.
  void apply(ImageView<const std::uint8_t> source, Image<std::uint8_t>& out);

  /// Blurs only `part` of the source, which lies inside it, into `out`, which has the part's size.
  void apply(ImageView<const std::uint8_t> source, const Region& part, ImageView<std::uint8_t> out);

 private:
  // What columns `first` … `last` − 1 beyond the source would have. `first_x`: of what is blurred.
  void mirror_columns(int first, int last, int first_x, int source_width);

  std::vector<const std::uint8_t*> rows_;  // of the source, as they are needed from the top
  Image<std::uint16_t> down_;              // blurred along y, in 16ths
};

}  // namespace puck
