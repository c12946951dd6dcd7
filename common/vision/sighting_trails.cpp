#include "common/vision/sighting_trails.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>

#include "common/vision/puck_detector.h"

namespace puck {
namespace {

// A search may miss it now and then.
constexpr int kMostMissed = 2;
// All that as many searches may leave.
constexpr std::size_t kMostTrails = (kMostMissed + 2) * PuckDetector::kMostDetections;
// How far from where it is expected it may be found: not knowing how fast it is, by one sighting's
// error, and by less still.
constexpr double kFastest_px_us = 1.6e-3;
constexpr double kFarthest_px = 10;
constexpr double kSecondGate_px = 3;
constexpr double kGate_px = 2;
// What lies nearer to the searched region's border may be found beyond it.
constexpr int kMargin_px = 3;
// Two searches so soon after one another see the same.
constexpr double kSameSearch_us = 2'000;
// Gains of a filter that forgets after some ten sightings.
constexpr double kLeastGain = 0.4;
constexpr double kLeastVelocityGain = 0.1;
constexpr double kLeastShare = 0.1;
// What creeps with an error in how what stands still moves gets nowhere in so long.
constexpr double kOwnMemory_s = 0.3;

// Of an average over so many, later over the last ten or so.
double share_of_newest(int count) { return std::max(kLeastShare, 1.0 / count); }

}  // namespace

SightingTrails::SightingTrails() {
  trails_.reserve(kMostTrails);
  seen_.reserve(PuckDetector::kMostDetections);
}

void SightingTrails::take(SearchResult& found, const PuckContour& contour,
                          const Background& background, bool head_rests) {
  time_us_ = found.time.us;
  const double sought = contour.wall_share(found.request.other_wall);
  const double calibrated = contour.wall_share(false);
  seen_.clear();
  for (const SearchCandidate& candidate : found.candidates) {
    if (seen_.size() == seen_.capacity()) break;
    seen_.push_back(
        {contour.centre_with_wall(candidate.position, sought, calibrated), candidate.score});
  }
  std::erase_if(trails_, [&](const Trail& trail) {
    return trail.missed > kMostMissed || time_us_ - trail.seen_us > SightingTrail::kEndsAfter_us;
  });
  // The longest first: what follows one is not another's.
  std::sort(trails_.begin(), trails_.end(), [](const Trail& a, const Trail& b) {
    return std::tuple(-a.sightings, a.missed, -a.score, a.position.x, a.position.y) <
           std::tuple(-b.sightings, b.missed, -b.score, b.position.x, b.position.y);
  });
  for (Trail& trail : trails_) follow(trail, found.request.region, background, head_rests);
  for (Seen& seen : seen_) {
    if (seen.trail || trails_.size() == trails_.capacity()) continue;
    seen.trail = &trails_.emplace_back(
        Trail{.position = seen.position, .seen_us = time_us_, .score = seen.score});
  }
  for (std::size_t i = 0; i < found.candidates.size(); ++i) {
    const Trail* const trail = i < seen_.size() ? seen_[i].trail : nullptr;
    found.candidates[i].trail = trail ? told(*trail) : SightingTrail{};
  }
}

void SightingTrails::follow(Trail& trail, const Region& searched, const Background& background,
                            bool head_rests) {
  const auto passed_us = static_cast<double>(time_us_ - trail.seen_us);
  const double passed_s = passed_us * 1e-6;
  const Pixel expected{trail.position.x + trail.velocity.x * passed_s,
                       trail.position.y + trail.velocity.y * passed_s};
  if (!searched.inflated(-kMargin_px)
           .contains(static_cast<int>(expected.x), static_cast<int>(expected.y))) {
    return;
  }
  const bool is_same_search = passed_us < kSameSearch_us;
  const double within_px = is_same_search || trail.sightings > 2 ? kGate_px
                           : trail.sightings == 2
                               ? kSecondGate_px
                               : std::min(kFarthest_px, kFastest_px_us * passed_us);
  Seen* const seen = nearest(expected, within_px);
  if (seen == nullptr) {
    if (!is_same_search) ++trail.missed;
    return;
  }
  seen->trail = &trail;
  if (is_same_search) return;
  const double dx = seen->position.x - expected.x;
  const double dy = seen->position.y - expected.y;
  const int n = ++trail.sightings;
  // Of a straight line through n points, as long as there are few.
  const double gain = std::max(kLeastGain, 2.0 * (2 * n - 1) / (n * (n + 1.0)));
  const double velocity_gain = n == 2 ? 1 : std::max(kLeastVelocityGain, 6.0 / (n * (n + 1.0)));
  const Pixel before = trail.position;
  trail.position = {expected.x + gain * dx, expected.y + gain * dy};
  trail.velocity.x += velocity_gain * dx / passed_s;
  trail.velocity.y += velocity_gain * dy / passed_s;
  const std::optional<PixelVelocity> still =
      head_rests ? PixelVelocity{} : background.still_velocity_at(expected);
  const double keep = std::exp(-passed_s / kOwnMemory_s);
  trail.own = {keep * trail.own.x, keep * trail.own.y};
  if (still) {
    trail.own.x += trail.position.x - before.x - still->x * passed_s;
    trail.own.y += trail.position.y - before.y - still->y * passed_s;
  }
  if (n > 2) trail.square += share_of_newest(n - 2) * (dx * dx + dy * dy - trail.square);
  trail.score += share_of_newest(n) * (seen->score - trail.score);
  trail.seen_us = time_us_;
  trail.missed = 0;
}

SightingTrails::Seen* SightingTrails::nearest(Pixel expected, double within_px) {
  Seen* best = nullptr;
  double least = within_px * within_px;
  for (Seen& seen : seen_) {
    const double dx = seen.position.x - expected.x;
    const double dy = seen.position.y - expected.y;
    const double square = dx * dx + dy * dy;
    if (seen.trail || square >= least) continue;
    least = square;
    best = &seen;
  }
  return best;
}

SightingTrail SightingTrails::told(const Trail& trail) {
  return {.sightings = trail.sightings,
          .own_px = std::hypot(trail.own.x, trail.own.y),
          .score = trail.score,
          .rms_px = std::sqrt(trail.square),
          .velocity = trail.velocity,
          .seen_us = trail.seen_us};
}

}  // namespace puck
