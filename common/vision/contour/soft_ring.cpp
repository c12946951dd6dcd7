#include "common/vision/contour/soft_ring.h"

#include <algorithm>
#include <cmath>

#include "common/vision/contour/ring_score.h"

namespace puck {
namespace {

// Distances from the ring are linear in a shift only for a short way; after a longer one the ring
// is laid anew.
constexpr double kFarShift_px = 0.5;
// Half the width of the soft ring. Wider finds the peak from farther away; narrower admits fewer
// pixels beside the contour.
constexpr double kSoftHalfWidth_px = 2.5;
constexpr int kIterations = 4;
constexpr double kConverged_px = 0.02;
// Largest distance of the peak from the start of the search.
constexpr double kFarthest_px = 2;
// Weight of a prior at the start, in bright pixels: stops a drift along an edge.
constexpr double kInertia = 2;

// The shift to the peak of the ring's correlation with a picture, Σ grey · profile(distance), with
// the profile (1 − (d / half width)²)². Each iteration shifts the ring so that the pixels' weighted
// distances come closest to zero; at a peak the shift is zero. A direction without bright pixels
// gets no shift.
Pixel shift_to_peak(const RingSamples& samples) {
  Pixel shift;
  const auto per_half_width = static_cast<float>(1 / kSoftHalfWidth_px);
  for (int i = 0; i < kIterations; ++i) {
    const auto shift_x = static_cast<float>(shift.x);
    const auto shift_y = static_cast<float>(shift.y);
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
    const double a = xx / 255.0 + kInertia;
    const double b = xy / 255.0;
    const double c = yy / 255.0 + kInertia;
    const double px = pull_x / 255.0 - kInertia * shift.x;
    const double py = pull_y / 255.0 - kInertia * shift.y;
    const double determinant = a * c - b * b;
    const Pixel before = shift;
    shift.x += (c * px - b * py) / determinant;
    shift.y += (a * py - b * px) / determinant;
    shift.x = std::clamp(shift.x, -kFarthest_px, kFarthest_px);
    shift.y = std::clamp(shift.y, -kFarthest_px, kFarthest_px);
    if (distance_px(shift, before) < kConverged_px) break;
  }
  return shift;
}

}  // namespace

SoftRing::Fit SoftRing::fit(ImageView<const std::uint8_t> picture, const Region& place,
                            Pixel start) {
  Pixel shift = look(picture, place, start);
  if (std::hypot(shift.x, shift.y) > kFarShift_px) {
    start = {start.x + shift.x, start.y + shift.y};
    shift = look(picture, place, start);
  }
  return {{start.x + shift.x, start.y + shift.y}, ring_score(samples_, shift)};
}

Pixel SoftRing::look(ImageView<const std::uint8_t> picture, const Region& place, Pixel start) {
  samples_.gather(picture, place, contour_.ring_at(start, contour_.wall_share(other_wall_)), start);
  return shift_to_peak(samples_);
}

}  // namespace puck
