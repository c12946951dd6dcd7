#pragma once

#include <cstdint>
#include <vector>

#include "common/vision/ellipse_kernel.h"
#include "common/vision/image.h"
#include "common/vision/region.h"

namespace puck {

/// The response of a kernel at each pixel of `region`.
struct CorrelationMap {
  Region region;
  Image<double> response;
};

/// Correlates a picture with elliptical kernels (paper, Section III-B, the convolution). Sums are
/// exact integers: the same as dense correlation. A kernel row costs two look-ups a shape, since
/// each row of the picture is summed up once beforehand.
class Correlation {
 public:
  /// Takes the picture; `region` is its place in the image. Pixels outside it count as dark. The
  /// picture may go away after the call.
  void set_picture(ImageView<const std::uint8_t> picture, const Region& region);

  /// The kernel's response with its anchor on each pixel of `candidates`, wherever they lie.
  void correlate(const EllipseKernel& kernel, const Region& candidates, CorrelationMap& out);

  /// How much the place around pixel (x, y) looks like a puck: EllipseKernel::contrast.
  double contrast_at(const EllipseKernel& kernel, int x, int y) const;

 private:
  // Sum of a picture row left of column x, 0 to the row's total beyond its ends.
  std::int32_t sum_left_of(int row, int x) const;
  // The sums left of `count` columns from `first` on, wherever they lie.
  const std::int32_t* sums_from(int row, int first, int count);

  Region region_;
  Image<std::int32_t> row_sums_;          // (x, y): sum of the row's pixels left of x
  std::vector<std::int32_t> padded_;      // one row of sums, extended past both ends
  std::vector<std::int32_t> canvas_sum_;  // of a row of candidates
  std::vector<std::int32_t> outer_sum_;
  std::vector<std::int32_t> inner_sum_;
};

}  // namespace puck
