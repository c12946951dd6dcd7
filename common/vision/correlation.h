#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/vision/block_sums.h"
#include "common/vision/ellipse_kernel.h"
#include "common/vision/gaussian_blur.h"
#include "common/vision/image.h"
#include "common/vision/kernel_sweep.h"
#include "common/vision/region.h"
#include "common/vision/row_sums.h"

namespace puck {

/// The response of a kernel at each pixel of `region`.
struct CorrelationMap {
  Region region;
  Image<double> response;
};

/// Correlates a picture with elliptical kernels (paper, Section III-B, the convolution). Sums are
/// exact integers: the same as dense correlation. Pixels outside the picture count as dark.
class Correlation {
 public:
  /// Takes the picture; `region` is its place in the image. It must not change or go away while it
  /// is correlated.
  void set_picture(ImageView<const std::uint8_t> picture, const Region& region);
  /// Takes a surface and blurs what is needed of it.
  void set_surface(ImageView<const std::uint8_t> surface, const Region& region);

  /// Makes the picture ready for all kernels that reach no farther than `region`. Otherwise it is
  /// made ready for each kernel as it comes.
  void cover(const Region& region);

  /// The kernel's response with its anchor on each pixel of `candidates`, wherever they lie.
  void correlate(const EllipseKernel& kernel, const Region& candidates, CorrelationMap& out);

  /// The lowest response of all candidates, which are at least one; of the responses themselves
  /// only those in `kept`, which lies inside the candidates, are sure to be there afterwards.
  double correlate_lowest(const EllipseKernel& kernel, const Region& candidates, const Region& kept,
                          CorrelationMap& out);

  /// No candidate has a lower weighted response, wherever it lies: found without correlating.
  double lower_bound(const EllipseKernel& kernel);

  /// How much the place around pixel (x, y) looks like a puck: EllipseKernel::contrast.
  double contrast_at(const EllipseKernel& kernel, int x, int y);

 private:
  void show(ImageView<const std::uint8_t> picture, const Region& region, bool blurs);
  void cover_reach(const EllipseKernel& kernel, const Region& candidates);
  // Where the kernel's measure is a sum with whole weights; the lowest response then.
  std::optional<double> weigh(const EllipseKernel& kernel, const Region& candidates,
                              const Region& kept, CorrelationMap& out);
  // Whatever the kernel's measure.
  void measure(const EllipseKernel& kernel, const Region& candidates, CorrelationMap& out);
  void sum_shapes(const EllipseKernel& kernel, const Region& candidates);

  ImageView<const std::uint8_t> picture_;
  Region region_;
  bool blurs_ = false;
  bool ready_ = false;
  bool in_blocks_ = false;
  BlockSums blocks_;
  GaussianBlur blur_;
  RowSums sums_of_rows_;
  KernelSweep sweep_;
  KernelSweep::Totals totals_;
  std::array<KernelSweep::Totals, 3> sums_;
};

}  // namespace puck
