#include "common/vision/wall_edge.h"

#include <algorithm>
#include <array>

namespace puck {
namespace {

constexpr double kRing_px = RingEvidence::kRing_px;
// At so many places from the end of the lower half to its middle: by which share of the distance
// there the edges differ.
constexpr std::array kShares{0.0980, 0.2903, 0.4714, 0.6344, 0.7730, 0.8819, 0.9569, 0.9952};

double lower_edge(const ContourRing& ring) { return ring.semi_y - ring.rise; }

// Mean width of the part of an edge's band that is not the ring's and not farther from it than
// `reach_px`, if the edges differ by `most_px` in the middle.
double mean_width_px(double most_px, double reach_px) {
  double sum = 0;
  for (const double share : kShares) {
    const double apart_px = share * most_px;
    sum += std::max(
        std::min(apart_px + kRing_px, reach_px) - std::max(apart_px - kRing_px, kRing_px), 0.0);
  }
  return sum / static_cast<double>(kShares.size());
}

}  // namespace

WallEdge::WallEdge(const ContourRing& followed, const ContourRing& other)
    : other_(other), areas_(RingEvidence::areas_of(followed)) {
  const double apart_px = lower_edge(other) - lower_edge(followed);
  is_known_ = apart_px != 0;
  const double length_px = other.band_area(0.5) / 2;
  if (apart_px > 0) {
    areas_.outside -= length_px * mean_width_px(apart_px, RingEvidence::kReach_px);
  } else {
    const double inner = std::min(other.inside_area(kRing_px), areas_.inside);
    areas_.inside =
        std::max(areas_.inside - length_px * mean_width_px(-apart_px, 2 * followed.semi_y), inner);
  }
}

}  // namespace puck
