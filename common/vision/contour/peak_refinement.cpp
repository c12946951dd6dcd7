#include "common/vision/contour/peak_refinement.h"

#include <algorithm>

namespace puck {
namespace {

// Weight of a prior at the start, in bright pixels: stops a drift along an edge.
constexpr double kInertia = 2;

constexpr double kConverged_px = 0.02;

}  // namespace

RefinedPeak refine_peak(const RingSamples& samples, const PeakRefinementParams& params) {
  RefinedPeak peak;
  const auto per_half_width = static_cast<float>(1 / params.half_width_px);
  for (int i = 0; i < params.iterations; ++i) {
    const auto shift_x = static_cast<float>(peak.shift.x);
    const auto shift_y = static_cast<float>(peak.shift.y);
    float xx = 0;
    float xy = 0;
    float yy = 0;
    float pull_x = 0;
    float pull_y = 0;
    for (const RingSample& sample : samples.bright()) {
      const float distance =
          sample.distance_px - sample.normal_x * shift_x - sample.normal_y * shift_y;
      const float u = distance * per_half_width;
      const float profile = std::max(0.0F, 1 - u * u);
      const float weight = profile * profile * sample.grey;
      const float weight_x = weight * sample.normal_x;
      const float weight_y = weight * sample.normal_y;
      xx += weight_x * sample.normal_x;
      xy += weight_x * sample.normal_y;
      yy += weight_y * sample.normal_y;
      pull_x += weight_x * distance;
      pull_y += weight_y * distance;
    }
    peak.hold_xx = xx / 255.0;
    peak.hold_xy = xy / 255.0;
    peak.hold_yy = yy / 255.0;
    const double a = peak.hold_xx + kInertia;
    const double b = peak.hold_xy;
    const double c = peak.hold_yy + kInertia;
    const double px = pull_x / 255.0 - kInertia * peak.shift.x;
    const double py = pull_y / 255.0 - kInertia * peak.shift.y;
    const double determinant = a * c - b * b;
    const Pixel before = peak.shift;
    peak.shift.x += (c * px - b * py) / determinant;
    peak.shift.y += (a * py - b * px) / determinant;
    peak.shift.x = std::clamp(peak.shift.x, -params.farthest_px, params.farthest_px);
    peak.shift.y = std::clamp(peak.shift.y, -params.farthest_px, params.farthest_px);
    if (distance_px(peak.shift, before) < kConverged_px) break;
  }
  return peak;
}

}  // namespace puck
