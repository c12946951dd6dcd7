#include "common/vision/wall_edge.h"

#include <algorithm>
#include <numbers>

namespace puck {
namespace {

constexpr double kRing_px = RingEvidence::kRing_px;

double area_to_outer_border(const ContourRing& ring) {
  return std::numbers::pi * (ring.semi_x + kRing_px) * (ring.semi_y + kRing_px);
}

}  // namespace

WallEdge::WallEdge(const ContourRing& followed, const ContourRing& other)
    : other_(other),
      areas_(RingEvidence::areas_of(followed)),
      is_known_(followed.semi_y != other.semi_y) {
  // The upper halves are the same, and near its ends the edge is a part of the ring.
  const double most = other.band_area(kRing_px) / 2;
  areas_.inside -= std::clamp(areas_.inside - other.inside_area(kRing_px), 0.0, most);
  areas_.outside -=
      std::clamp(area_to_outer_border(other) - area_to_outer_border(followed), 0.0, most);
}

}  // namespace puck
