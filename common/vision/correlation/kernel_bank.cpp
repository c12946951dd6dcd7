#include "common/vision/correlation/kernel_bank.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

double semi_axis(int size_px, const KernelBankParams& params) {
  return params.whole_semi_axes ? std::floor(size_px / 2) : size_px / 2.0;
}

EllipseKernel draw(int width_px, int height_px, const KernelBankParams& params) {
  KernelGeometry geometry;
  geometry.canvas_width = width_px + params.margin_x_px;
  geometry.canvas_height = height_px + params.margin_y_px;
  geometry.anchor_x = geometry.canvas_width / 2;
  geometry.anchor_y = geometry.canvas_height / 2;
  geometry.origin_x = geometry.anchor_x;
  geometry.origin_y = geometry.anchor_y;
  geometry.semi_x = semi_axis(width_px, params);
  geometry.semi_y = semi_axis(height_px, params);
  return {geometry, params.profile};
}

}  // namespace

KernelBank::KernelBank(const KernelBankParams& params) : params_(params) {
  if (params.smallest_px < 3 || params.smallest_px % 2 == 0 || params.largest_px % 2 == 0 ||
      params.largest_px < params.smallest_px) {
    throw std::invalid_argument("a kernel bank needs odd sizes from 3 px up, got " +
                                std::to_string(params.smallest_px) + " to " +
                                std::to_string(params.largest_px));
  }
  if (!(params.size_scale > 0)) {
    throw std::invalid_argument("a kernel bank needs a positive scale, got " +
                                std::to_string(params.size_scale));
  }
  sizes_ = (params.largest_px - params.smallest_px) / 2 + 1;
  kernels_.reserve(static_cast<std::size_t>(sizes_ * sizes_));
  for (int row = 0; row < sizes_; ++row) {
    for (int column = 0; column < sizes_; ++column) {
      kernels_.push_back(draw(size_at(column), size_at(row), params));
    }
  }
}

const EllipseKernel& KernelBank::nearest(PuckSize size) const {
  return kernels_[static_cast<std::size_t>(index_of(size.height) * sizes_ + index_of(size.width))];
}

PuckSize KernelBank::nominal(PuckSize size) const {
  return {static_cast<double>(size_at(index_of(size.width))),
          static_cast<double>(size_at(index_of(size.height)))};
}

// Sizes grow towards a border of the image, so the widest kernel in a region is that of one of its
// corners; and no puck is higher than it is wide.
int KernelBank::reach_beyond(const Region& region, const PuckSizeModel& size_model) const {
  int reach = 0;
  for (const int x : {region.x, region.right() - 1}) {
    for (const int y : {region.y, region.bottom() - 1}) {
      const EllipseKernel& kernel =
          nearest(size_model.at({static_cast<double>(x), static_cast<double>(y)}));
      reach = std::max({reach, kernel.width() / 2 + 1, kernel.height() / 2 + 1});
    }
  }
  return reach;
}

int KernelBank::index_of(double contour_px) const {
  const double size_px = contour_px * params_.size_scale;
  // NaN compares false and takes the smallest size.
  if (!(size_px > params_.smallest_px)) return 0;
  if (size_px >= params_.largest_px) return sizes_ - 1;
  const int odd = 2 * static_cast<int>(std::floor(size_px / 2)) + 1;
  return std::min((odd - params_.smallest_px) / 2, sizes_ - 1);
}

}  // namespace puck
