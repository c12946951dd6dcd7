#pragma once

#include <vector>

#include "common/vision/correlation/ellipse_kernel.h"
#include "common/vision/geometry/pixel.h"
#include "common/vision/geometry/puck_size_model.h"
#include "common/vision/geometry/region.h"

namespace puck {

/// Drawing of a bank's kernels for a puck of width × height px.
struct KernelBankParams {
  KernelProfile profile;
  /// The kernel's nominal size relative to the puck's contour: the ellipse on which the profile's
  /// squared normalised radius is 1.
  double size_scale = 1;
  /// Odd sizes from the smallest to the largest, both directions; others are clamped to them.
  int smallest_px = 9;
  int largest_px = 51;
  /// Canvas beyond the puck, both sides together, px.
  int margin_x_px = 4;
  int margin_y_px = 4;
  /// Semi-axes rounded down to whole pixels, as the authors' code draws them.
  bool whole_semi_axes = true;
};

/// A kernel for every odd width and height, made once at construction.
class KernelBank {
 public:
  /// Throws std::invalid_argument when the sizes are not odd and in order, the scale is not positive,
  /// or a kernel would be too wide (EllipseKernel).
  explicit KernelBank(const KernelBankParams& params);

  /// The kernel for a puck whose contour has this size.
  const EllipseKernel& nearest(PuckSize size) const;
  /// That kernel's nominal size: scaled, made odd by 2·floor(v / 2) + 1, and clamped.
  PuckSize nominal(PuckSize size) const;
  /// Reach beyond `region`, px, of the kernels for the places inside it.
  int reach_beyond(const Region& region, const PuckSizeModel& size_model) const;

 private:
  int index_of(double contour_px) const;
  int size_at(int index) const { return params_.smallest_px + 2 * index; }

  KernelBankParams params_;
  int sizes_;
  std::vector<EllipseKernel> kernels_;  // by height, then width
};

}  // namespace puck
