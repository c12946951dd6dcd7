#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "common/vision/correlation/block_sums.h"
#include "common/vision/correlation/ellipse_kernel.h"
#include "common/vision/correlation/gaussian_blur.h"
#include "common/vision/correlation/kernel_sweep.h"
#include "common/vision/correlation/row_sums.h"
#include "common/vision/geometry/image.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// The response of a kernel at each pixel of `region`.
struct CorrelationMap {
  Region region;
  Image<double> response;
};

/// Correlates a blurred surface with elliptical kernels (paper, Section III-B, the convolution).
/// Sums are exact integers: the same as dense correlation. Pixels outside the surface count as
/// dark.
class Correlation {
 public:
  /// Sets the surface; `region` is its place in the image. It must stay unchanged while it is
  /// correlated.
  void set_surface(ImageView<const std::uint8_t> surface, const Region& region);

  /// Blurs the surface for all kernels that reach no farther than `region`. Without it each
  /// kernel prepares its own part.
  void cover(const Region& region);

  /// The kernel's response with its anchor on each pixel of `candidates`, also outside the surface.
  void correlate(const EllipseKernel& kernel, const Region& candidates, CorrelationMap& out);

  /// The lowest response of all candidates, of which there is at least one. `out` holds at least
  /// the responses in `kept`, which lies inside the candidates.
  double correlate_lowest(const EllipseKernel& kernel, const Region& candidates, const Region& kept,
                          CorrelationMap& out);

  /// Lower bound on the weighted response at any candidate, without correlating.
  double lower_bound(const EllipseKernel& kernel);

  /// Calls `on_part(const Region&)` with parts of a row of candidates, from left to right: all
  /// places at which the kernel covers more than dark pixels, and some others.
  template <typename OnPart>
  void for_each_bright_part(const EllipseKernel& kernel, const Region& row, const OnPart& on_part);

  /// Similarity of the place around pixel (x, y) to a puck: EllipseKernel::contrast.
  double contrast_at(const EllipseKernel& kernel, int x, int y);

 private:
  void sum_blocks();
  void cover_reach(const EllipseKernel& kernel, const Region& candidates);
  // Returns the lowest response, if the kernel's measure is a sum with whole weights.
  std::optional<double> weigh(const EllipseKernel& kernel, const Region& candidates,
                              const Region& kept, CorrelationMap& out);
  // For any measure.
  void measure(const EllipseKernel& kernel, const Region& candidates, CorrelationMap& out);

  ImageView<const std::uint8_t> surface_;
  Region region_;
  bool ready_ = false;
  bool in_blocks_ = false;
  BlockSums blocks_;
  GaussianBlur blur_;
  RowSums sums_of_rows_;
  KernelSweep sweep_;
  KernelSweep::Totals totals_;
  std::array<KernelSweep::Totals, 3> sums_;
};

template <typename OnPart>
void Correlation::for_each_bright_part(const EllipseKernel& kernel, const Region& row,
                                       const OnPart& on_part) {
  constexpr int kSide = BlockSums::kSide;
  sum_blocks();
  // What the kernel covers from the row's first place, on the surface, and the blur beyond it.
  constexpr int kBlur = GaussianBlur::kRadius;
  const int top = row.y - kernel.anchor_y() - kBlur - region_.y;
  const int left = row.x - kernel.anchor_x() - kBlur - region_.x;
  const auto& columns = blocks_.columns_between(top, top + kernel.height() + 2 * kBlur);
  Region part{row.x, row.y, 0, 1};
  for (int x = 0; x < row.width; x += kSide) {
    const int places = std::min(kSide, row.width - x);
    const int first = std::max(left + x, 0);
    const int last = std::min(left + x + places - 1 + kernel.width() + 2 * kBlur, surface_.width());
    bool is_bright = false;
    for (int i = first / kSide; i * kSide < last; ++i) {
      is_bright |= columns[static_cast<std::size_t>(i)] > 0;
    }
    if (is_bright) {
      part.width += places;
      continue;
    }
    if (!part.empty()) on_part(part);
    part = {row.x + x + places, row.y, 0, 1};
  }
  if (!part.empty()) on_part(part);
}

}  // namespace puck
