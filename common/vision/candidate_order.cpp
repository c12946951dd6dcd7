#include "common/vision/candidate_order.h"

#include <algorithm>

namespace puck {

void put_still_last(std::vector<SearchCandidate>& candidates, const Background& background,
                    const PuckContour& contour) {
  constexpr double kStillShare = 0.6;
  // std::stable_partition would ask for memory, which no tracking thread does.
  auto moving_end = candidates.begin();
  for (auto candidate = candidates.begin(); candidate != candidates.end(); ++candidate) {
    const ContourRing ring = contour.ring_at(candidate->position, contour.calibrated_wall_share());
    if (background.still_share(ring, candidate->position) >= kStillShare) continue;
    std::rotate(moving_end, candidate, candidate + 1);
    ++moving_end;
  }
}

}  // namespace puck
