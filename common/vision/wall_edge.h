#pragma once

#include <cmath>

#include "common/vision/puck_contour.h"
#include "common/vision/ring_evidence.h"

namespace puck {

/// The other edge of a puck whose face and side wall differ in tone. One of both is the contour
/// that is followed: the face's, or that of the whole puck. The other lies a wall's height below or
/// above its lower half, and what lies there says nothing for the puck or against it.
class WallEdge {
 public:
  WallEdge() = default;
  /// `followed` and `other`: PuckContour::ring_at the same centre with the two wall shares.
  WallEdge(const ContourRing& followed, const ContourRing& other);

  /// Whether a pixel at (dx, dy) from the puck's centre, that is not on the ring which is followed,
  /// is on the other edge; the puck larger by `growth_px` all round.
  bool contains(double dx, double dy, double growth_px) const {
    return is_known_ &&
           std::abs(other_.offset(dx, dy, growth_px).distance_px) <= RingEvidence::kRing_px;
  }

  /// RingEvidence::areas_of the ring that is followed, but for the edge.
  RingAreas areas() const { return areas_; }

 private:
  ContourRing other_;
  RingAreas areas_;
  bool is_known_ = false;
};

}  // namespace puck
