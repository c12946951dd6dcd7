#include "common/vision/claim.h"

#include <algorithm>

#include "common/vision/background.h"

namespace puck {
namespace {

// What is counted must not be the first few events of anything.
constexpr std::int64_t kClearAfter_us = 1'000;
constexpr std::int64_t kLikelyAfter_us = 10'000;
constexpr std::int64_t kRestsAfter_us = 15'000;
// Half hidden and moving one way a puck has events in so large a share of the directions.
constexpr double kLeastCover = 0.28;
// A puck that lies there has events all around, but for where its edge lies along its way.
constexpr double kMostOfTheWay = 0.6;
// In the scene what stands still seems to move by less than this, in PuckContour::turning_px_s …
constexpr double kWithScene = 0.5;
// … or by less than this, since a filter's velocity is no better on few events.
constexpr double kFilterNoise_px_s = 120;
// What rests in it does so by less on most of its events.
constexpr double kRestsWithin_px_s = 60;
// What slides along an edge is slower than this, in PuckContour::turning_px_s.
constexpr double kBeyondSliding = 2;

std::optional<double> own_speed_px_s(const ContourFilter& filter, const ClaimContext& context) {
  if (context.background == nullptr) return std::nullopt;
  return context.background->own_speed_px_s(filter.position(), filter.velocity());
}

}  // namespace

Claim claim_of(const Challenger& challenger, const ClaimContext& context, std::int64_t time_us) {
  const ContourTrack& track = challenger.track();
  Challenger::Found found = challenger.found();
  if (time_us - found.trail.seen_us > SightingTrail::kEndsAfter_us) found.trail = {};
  return {.looks = track.looks(),
          .age_us = challenger.age_us(time_us),
          .found = found,
          .leads = challenger.leads(),
          .has_other_wall = challenger.has_other_wall(),
          .own_speed_px_s = own_speed_px_s(track.filter(), context),
          .context = context};
}

// The bounds are such that of some 2,000 wrong claims of this age of development games none passes,
// of right ones half.
bool is_clear_at_once(const Claim& claim) {
  const TrackLooks& looks = claim.looks;
  if (!claim.context.at_once || claim.age_us <= kClearAfter_us || !claim.leads ||
      !looks.is_fast() || looks.cover <= kLeastCover || !looks.has_pucks_size()) {
    return false;
  }
  return (looks.quality > 0.65 && looks.is_very_strong()) ||
         (looks.quality > 0.85 && looks.strength > 60) ||
         (looks.quality > 0.7 && support(claim) > 2.15);
}

bool is_adrift(const Claim& claim) {
  if (!claim.own_speed_px_s) return false;
  const TrackLooks& looks = claim.looks;
  const double own_px_s = *claim.own_speed_px_s;
  const bool cannot_slide =
      looks.is_very_strong() ||
      (looks.is_whole_ring() && own_px_s > kBeyondSliding * looks.turning_px_s);
  return own_px_s > std::max(kWithScene * looks.turning_px_s, kFilterNoise_px_s) && !cannot_slide;
}

// The bounds are such that within half a second of 80 development games at low contrast the puck is
// the first that passes in 60, and something else in 2. Spots like the puck pass as well.
bool rests_in_scene(const Claim& claim) {
  const TrackLooks& looks = claim.looks;
  return claim.context.scene_rests && claim.own_speed_px_s &&
         *claim.own_speed_px_s < kRestsWithin_px_s && claim.age_us > kRestsAfter_us &&
         claim.leads && looks.quality > 0.75 && looks.strength > 12 &&
         looks.cover > kMostOfTheWay && looks.has_pucks_size();
}

bool is_likely(const Claim& claim) {
  const TrackLooks& looks = claim.looks;
  return claim.context.at_once && claim.age_us > kLikelyAfter_us && looks.quality > 0.75 &&
         looks.strength > 15 && looks.is_whole_ring() && looks.has_pucks_size() &&
         support(claim) > 1.9;
}

// The bounds are such that in 41 development games with a moving camera the puck is the first that
// passes: each of 20 printed ones within 0.11 s, and nothing else within 0.59 s.
bool may_be_printed(const Claim& claim) {
  const TrackLooks& looks = claim.looks;
  return claim.context.face_print && claim.age_us > kLikelyAfter_us && claim.leads &&
         looks.printed_quality > 0.75 && looks.strength > 40 && looks.cover > 0.75 &&
         !looks.is_large() && !looks.is_undersized() && claim.found.score > kLikelyScore;
}

}  // namespace puck
