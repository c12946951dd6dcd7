#include "common/vision/contour/ring_samples.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

// A ring that reaches farther lies in no image; the size model led nowhere.
constexpr double kFarthestReach_px = 1e6;

// How far a row of an ellipse reaches to each side of its middle.
double half_chord(double semi_x, double semi_y, double y) {
  if (!(semi_x > 0 && semi_y > 0)) return -1;
  const double v = y / semi_y;
  return v * v < 1 ? semi_x * std::sqrt(1 - v * v) : -1;
}

// Of a row, from its middle: as far as what is near the ring reaches, and as far as what is not.
struct Chords {
  double middle = 0;
  double outer = -1;
  double inner = -1;
};

Chords chords_of(const ContourRing& ring, double ring_y) {
  constexpr double kReach_px = RingSamples::kReachPx;
  const double semi_y = ring.face_semi_y();
  if (ring.half_wall == 0) {
    return {ring.shear * ring_y, half_chord(ring.semi_x + kReach_px, semi_y + kReach_px, ring_y),
            half_chord(ring.semi_x - kReach_px, semi_y - kReach_px, ring_y)};
  }
  // Of what is drawn out, the rows are as wide as the wider, and the narrower, of those that either
  // end of the straight sides makes of them.
  const double upper = ring_y + ring.half_wall;
  const double lower = ring_y - ring.half_wall;
  if (upper < -semi_y - kReach_px || lower > semi_y + kReach_px) return {};
  const double slant = std::abs(ring.shear) * ring.half_wall;
  const double farther = std::abs(upper) > std::abs(lower) ? upper : lower;
  return {ring.shear * ring_y, ring.drawn_out_semi_x() + slant + kReach_px,
          half_chord(ring.semi_x - kReach_px, semi_y - kReach_px, farther) - slant};
}

}  // namespace

double RingSamples::reach_x(const ContourRing& ring) {
  return ring.semi_x + std::abs(ring.shear) * (ring.semi_y + kReachPx) + kReachPx;
}

double RingSamples::reach_y(const ContourRing& ring) {
  return ring.semi_y + std::abs(ring.rise) + kReachPx;
}

void RingSamples::gather(ImageView<const std::uint8_t> picture, const Region& place,
                         const ContourRing& ring, Pixel centre) {
  near_.clear();
  bright_ = 0;
  inside_sum_ = 0;
  inside_pixels_ = 0;
  // Also when it is not a number.
  if (!(reach_x(ring) < kFarthestReach_px && reach_y(ring) < kFarthestReach_px)) return;
  const auto add_inside = [this](std::uint8_t pixel) {
    inside_sum_ += pixel;
    ++inside_pixels_;
  };
  const auto first_row = static_cast<int>(std::ceil(centre.y - reach_y(ring)));
  const auto last_row = static_cast<int>(std::floor(centre.y + reach_y(ring)));
  for (int y = std::max(first_row, place.y); y <= std::min(last_row, place.bottom() - 1); ++y) {
    const double ring_y = y - centre.y + ring.rise;
    const Chords chords = chords_of(ring, ring_y);
    if (chords.outer < 0) continue;
    const double middle = centre.x + chords.middle;
    const std::uint8_t* row = picture.row(y - place.y) - place.x;
    const int first = std::max(static_cast<int>(std::ceil(middle - chords.outer)), place.x);
    const int last =
        std::min(static_cast<int>(std::floor(middle + chords.outer)), place.right() - 1);
    for (int x = first; x <= last; ++x) {
      if (std::abs(x - middle) < chords.inner) {
        add_inside(row[x]);
        continue;
      }
      const ContourOffset offset = ring.offset(x - centre.x, y - centre.y, 0);
      if (ring.half_wall > 0 && std::abs(offset.distance_px) > kReachPx) {
        if (offset.distance_px < 0) add_inside(row[x]);
        continue;
      }
      near_.push_back({static_cast<float>(offset.distance_px), static_cast<float>(offset.normal_x),
                       static_cast<float>(offset.normal_y), static_cast<float>(row[x]),
                       offset.sector});
    }
  }
  const auto dark = std::partition(near_.begin(), near_.end(),
                                   [](const RingSample& sample) { return sample.grey > 0; });
  bright_ = static_cast<std::size_t>(dark - near_.begin());
}

}  // namespace puck
