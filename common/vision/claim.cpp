#include "common/vision/claim.h"

namespace puck {
namespace {

// What is counted must not be the first few events of anything.
constexpr std::int64_t kClearAfter_us = 1'000;
constexpr std::int64_t kLikelyAfter_us = 10'000;
// Half hidden and moving one way a puck has events in so large a share of the directions.
constexpr double kLeastCover = 0.28;

}  // namespace

Claim claim_of(const Challenger& challenger, const ClaimContext& context, std::int64_t time_us) {
  return {challenger.track().looks(), challenger.age_us(time_us),  challenger.found(),
          challenger.leads(),         challenger.has_other_wall(), context};
}

// The bounds are such that of some 2,000 wrong claims of this age of development games none passes,
// of right ones half.
bool is_clear_at_once(const Claim& claim) {
  const TrackLooks& looks = claim.looks;
  if (!claim.context.at_once || claim.age_us <= kClearAfter_us || !claim.leads ||
      !looks.is_fast() || looks.cover <= kLeastCover || !looks.has_pucks_size()) {
    return false;
  }
  return (looks.quality > 0.65 && looks.strength > 80) ||
         (looks.quality > 0.85 && looks.strength > 60) ||
         (looks.quality > 0.7 && support(claim) > 2.15);
}

bool is_likely(const Claim& claim) {
  const TrackLooks& looks = claim.looks;
  return claim.context.at_once && claim.age_us > kLikelyAfter_us && looks.quality > 0.75 &&
         looks.strength > 15 && looks.is_whole_ring() && looks.has_pucks_size() &&
         support(claim) > 1.9;
}

}  // namespace puck
