#include "common/vision/seen_score.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr double kSeenWithin_px = 4;
constexpr double kForgotten = 0.03;

}  // namespace

void SeenScore::note(const SearchResult& result, Pixel main, bool has_other_wall) {
  const SearchRequest& request = result.request;
  if (request.other_wall != has_other_wall) return;
  double seen = 0;
  for (const SearchCandidate& candidate : result.candidates) {
    if (distance_px(candidate.position, main) < kSeenWithin_px)
      seen = std::max(seen, candidate.score);
  }
  const int x = static_cast<int>(std::floor(main.x));
  const int y = static_cast<int>(std::floor(main.y));
  const bool is_elsewhere = image_.contains(x, y) && !request.region.contains(x, y);
  score_ = std::max(seen, is_elsewhere ? score_ : score_ - kForgotten);
}

}  // namespace puck
