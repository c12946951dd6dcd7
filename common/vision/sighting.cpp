#include "common/vision/sighting.h"

namespace puck {
namespace {

// Nine of ten sightings of such a score within so many px of a poor track were of the puck, and of
// those that were not, the track was not either.
constexpr double kNearTrack_px = 10;
constexpr double kSightingScore = 0.62;

}  // namespace

std::optional<Sighting> sighting_near(Pixel main, double wall_share, const SearchResult& result,
                                      const PuckContour& contour) {
  const double sought = contour.wall_share(result.request.other_wall);
  std::optional<Sighting> seen;
  double best = 0;
  for (const SearchCandidate& candidate : result.candidates) {
    const Pixel place = contour.centre_with_wall(candidate.position, sought, wall_share);
    if (candidate.score <= best || distance_px(place, main) >= kNearTrack_px) continue;
    const bool is_sure = candidate.score > kSightingScore || candidate.trail.is_certain();
    if (!is_sure && !candidate.trail.is_steady()) continue;
    best = candidate.score;
    seen = Sighting{place, is_sure, candidate.trail.is_certain()};
  }
  return seen;
}

}  // namespace puck
