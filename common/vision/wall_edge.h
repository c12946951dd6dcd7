#pragma once

#include "common/vision/puck_contour.h"
#include "common/vision/ring_evidence.h"

namespace puck {

/// The other edge of a puck whose face and side wall differ in tone. One of both is the contour
/// that is followed: the face's, or that of the whole puck. The other lies a wall's height below or
/// above its lower half. What lies there says nothing for the contour or against it; it may cover
/// the puck all the same.
class WallEdge {
 public:
  WallEdge() = default;
  /// `followed` and `other`: PuckContour::ring_at the same centre with the two wall shares.
  WallEdge(const ContourRing& followed, const ContourRing& other);

  /// Whether there is one; only then the rest has a meaning.
  bool is_known() const { return is_known_; }
  const ContourRing& ring() const { return other_; }
  /// RingEvidence::areas_of the ring that is followed, without what is the edge's.
  RingAreas areas() const { return areas_; }

 private:
  ContourRing other_;
  RingAreas areas_;
  bool is_known_ = false;
};

}  // namespace puck
