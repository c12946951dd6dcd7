#pragma once

#include <cstdint>
#include <vector>

#include "common/vision/geometry/image.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// Smooths a surface before the correlation: 5×5 Gaussian, sigma about 1.1 px, in 8-bit fixed
/// point, with the source mirrored about its outermost pixels. The result equals OpenCV's
/// GaussianBlur(…, Size(5, 5), 0), which the authors' code calls. Every instruction set gives the
/// same bytes.
class GaussianBlur {
 public:
  /// Radius of the window, px.
  static constexpr int kRadius = 2;
  /// Largest factor by which a pixel's grey enters the sum of the result in a picture larger than 4
  /// × 4 px, rounding aside: mirrored pixels count more than once, 20 of 16ths in each direction.
  static constexpr double kMostGain = 1.25 * 1.25;

  /// Blurs all of `source` into `out`, which takes its size.
  void apply(ImageView<const std::uint8_t> source, Image<std::uint8_t>& out);

  /// Blurs only `part` of the source, which lies inside it, into `out`, which has the part's size.
  void apply(ImageView<const std::uint8_t> source, const Region& part, ImageView<std::uint8_t> out);

 private:
  // Mirrors columns `first` … `last` − 1 beyond the source. `first_x`: first blurred column.
  void mirror_columns(int first, int last, int first_x, int source_width);

  std::vector<const std::uint8_t*> rows_;  // of the source, in the order of use
  Image<std::uint16_t> down_;              // blurred along y, in 16ths
};

}  // namespace puck
