#include "common/vision/candidate_order.h"

#include <algorithm>

namespace puck {

void put_still_last(std::vector<SearchCandidate>& candidates, const Background& background,
                    const PuckContour& contour) {
  constexpr double kStillShare = 0.6;
  std::stable_partition(candidates.begin(), candidates.end(),
                        [&](const SearchCandidate& candidate) {
                          const ContourRing ring =
                              contour.ring_at(candidate.position, contour.calibrated_wall_share());
                          return background.still_share(ring, candidate.position) < kStillShare;
                        });
}

}  // namespace puck
