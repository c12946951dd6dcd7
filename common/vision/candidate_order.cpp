#include "common/vision/candidate_order.h"

#include <algorithm>

namespace puck {

void put_still_last(SearchResult& found, const Background& background, const PuckContour& contour,
                    double clear_score) {
  constexpr double kStillShare = 0.6;
  const double wall_share = contour.wall_share(found.request.other_wall);
  std::vector<SearchCandidate>& candidates = found.candidates;
  const auto is_still = [&](const SearchCandidate& candidate) {
    if (candidate.score > clear_score) return false;
    const ContourRing ring = contour.ring_at(candidate.position, wall_share);
    return background.still_share(ring, candidate.position) >= kStillShare;
  };
  // std::stable_partition would ask for memory, which no tracking thread does.
  auto moving_end = candidates.begin();
  for (auto candidate = candidates.begin(); candidate != candidates.end(); ++candidate) {
    if (is_still(*candidate)) continue;
    std::rotate(moving_end, candidate, candidate + 1);
    ++moving_end;
  }
}

}  // namespace puck
