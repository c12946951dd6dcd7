#include "common/vision/contour/ring_score.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace puck {
namespace {

constexpr double kHalfWidth_px = 2;
constexpr double kGreyDoubt = 0.05 * 255;
// A sector of which less can be seen, in pixels on the contour, tells nothing.
constexpr double kLeastWeight = 1;

struct Sector {
  double ring = 0;
  double ring_weight = 0;
  double outside = 0;
  double outside_pixels = 0;
};

double mean(double sum, double count) { return count > 0 ? sum / count : 0; }

}  // namespace

double ring_score(const RingSamples& samples, Pixel shift) {
  std::array<Sector, kContourSectors> sectors{};
  double inside = samples.inside_sum();
  double inside_pixels = samples.inside_pixels();
  for (const RingSample& sample : samples.near()) {
    Sector& sector = sectors[static_cast<std::size_t>(sample.sector)];
    const double distance =
        sample.distance_px - sample.normal_x * shift.x - sample.normal_y * shift.y;
    const double u = distance / kHalfWidth_px;
    const double weight = 1 - u * u;
    if (weight > 0) {
      sector.ring += weight * sample.grey;
      sector.ring_weight += weight;
    } else if (distance > 0) {
      sector.outside += sample.grey;
      sector.outside_pixels += 1;
    } else {
      inside += sample.grey;
      inside_pixels += 1;
    }
  }

  const double inside_grey = mean(inside, inside_pixels);
  double contrasts = 0;
  double sum = 0;
  double squares = 0;
  int seen = 0;
  for (const Sector& sector : sectors) {
    if (sector.ring_weight < kLeastWeight) continue;
    ++seen;
    const double ring = sector.ring / sector.ring_weight;
    const double around = (inside_grey + mean(sector.outside, sector.outside_pixels)) / 2;
    contrasts += std::max(0.0, (ring - around) / (ring + around + kGreyDoubt));
    sum += ring;
    squares += ring * ring;
  }
  if (!(squares > 0)) return 0;
  return std::sqrt(contrasts / seen * sum * sum / (kContourSectors * squares));
}

}  // namespace puck
