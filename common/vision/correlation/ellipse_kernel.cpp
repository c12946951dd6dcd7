#include "common/vision/correlation/ellipse_kernel.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

// The pixels of one row whose squared normalised radius is at most `boundary`. An ellipse is
// convex, so they form one run.
EllipseKernel::Run run_within(const KernelGeometry& geometry, int row, double boundary) {
  const double v = (row - geometry.origin_y) / geometry.semi_y;
  EllipseKernel::Run run;
  for (int column = 0; column < geometry.canvas_width; ++column) {
    const double u = (column - geometry.origin_x) / geometry.semi_x;
    if (u * u + v * v > boundary) continue;
    if (run.first == run.last) run.first = static_cast<std::int16_t>(column);
    run.last = static_cast<std::int16_t>(column + 1);
  }
  return run;
}

double share_of_one(int pixels) { return 1.0 / std::max(pixels, 1); }

// The factor in units of the weights; nothing where it is not a whole number of them.
std::optional<std::int16_t> whole_weight(double factor) {
  constexpr double kLargest = 1000;
  constexpr double kWhole = 1e-9;
  const double units = factor / EllipseKernel::kWeightUnit;
  const double whole = std::nearbyint(units);
  if (!(std::abs(units - whole) < kWhole && std::abs(whole) < kLargest)) return std::nullopt;
  return static_cast<std::int16_t>(whole);
}

}  // namespace

EllipseKernel::EllipseKernel(const KernelGeometry& geometry, const KernelProfile& profile)
    : geometry_(geometry), measure_(profile.measure) {
  if (geometry.canvas_width < 1 || geometry.canvas_height < 1 || !(geometry.semi_x > 0) ||
      !(geometry.semi_y > 0)) {
    throw std::invalid_argument("a kernel needs a canvas of at least one pixel and positive axes");
  }
  if (geometry.canvas_width > kWidest) {
    throw std::invalid_argument("a kernel may be " + std::to_string(kWidest) +
                                " px wide at most, got " + std::to_string(geometry.canvas_width));
  }
  for (int row = 0; row < geometry.canvas_height; ++row) {
    const Run outer = run_within(geometry, row, profile.outer_boundary);
    const Run inner = run_within(geometry, row, profile.inner_boundary);
    outer_.push_back(outer);
    inner_.push_back(inner);
    inside_pixels_ += inner.last - inner.first;
    inner_width_ = std::max(inner_width_, inner.last - inner.first);
    if (inner.last != inner.first) ++inner_height_;
    ring_pixels_ += (outer.last - outer.first) - (inner.last - inner.first);
  }
  outside_pixels_ = geometry.canvas_width * geometry.canvas_height - ring_pixels_ - inside_pixels_;

  per_inside_pixel_ = share_of_one(inside_pixels_);
  per_ring_pixel_ = share_of_one(ring_pixels_);
  per_outside_pixel_ = share_of_one(outside_pixels_);
  canvas_factor_ = profile.outside_weight;
  outer_factor_ = profile.ring_weight - profile.outside_weight;
  inner_factor_ = profile.inside_weight - profile.ring_weight;

  if (measure_ == KernelMeasure::kContrast) return;
  lowest_response_ = 255 * (std::min(profile.inside_weight, 0.0) * inside_pixels_ +
                            std::min(profile.ring_weight, 0.0) * ring_pixels_ +
                            std::min(profile.outside_weight, 0.0) * outside_pixels_);
  canvas_floor_ = std::min({profile.ring_weight, profile.outside_weight, 0.0});
  inner_floor_ = std::min(profile.inside_weight - canvas_floor_, 0.0);
  const auto canvas = whole_weight(canvas_factor_);
  const auto outer = whole_weight(outer_factor_);
  const auto inner = whole_weight(inner_factor_);
  if (!canvas || !outer || !inner) return;
  const double most = 255.0 * geometry.canvas_width * geometry.canvas_height *
                      (std::abs(*canvas) + std::abs(*outer) + std::abs(*inner));
  if (most < std::numeric_limits<std::int32_t>::max()) {
    whole_weights_ = WholeWeights{*canvas, *outer, *inner};
  }
}

}  // namespace puck
