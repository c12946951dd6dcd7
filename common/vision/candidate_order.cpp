#include "common/vision/candidate_order.h"

#include <algorithm>

namespace puck {
namespace {

// std::stable_partition would ask for memory, which no tracking thread does.
template <typename Predicate>
void put_first(std::vector<SearchCandidate>& candidates, const Predicate& is_preferred) {
  auto preferred_end = candidates.begin();
  for (auto candidate = candidates.begin(); candidate != candidates.end(); ++candidate) {
    if (!is_preferred(*candidate)) continue;
    std::rotate(preferred_end, candidate, candidate + 1);
    ++preferred_end;
  }
}

}  // namespace

void put_still_last(SearchResult& found, const Background& background, const PuckContour& contour,
                    double clear_score) {
  constexpr double kStillShare = 0.6;
  const double wall_share = contour.wall_share(found.request.other_wall);
  put_first(found.candidates, [&](const SearchCandidate& candidate) {
    if (candidate.score > clear_score) return true;
    const ContourRing ring = contour.ring_at(candidate.position, wall_share);
    return background.still_share(ring, candidate.position) < kStillShare;
  });
}

void put_followed_first(SearchResult& found) {
  put_first(found.candidates,
            [](const SearchCandidate& candidate) { return candidate.trail.is_likely(); });
}

}  // namespace puck
