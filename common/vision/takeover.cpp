#include "common/vision/takeover.h"

#include <algorithm>

namespace puck {
namespace {

// A lead over fewer events is chance more often than not. Opinions on the wall differ by little.
constexpr std::int64_t kTwinAge_us = 1'500;
constexpr std::int64_t kWitnessAge_us = 900;
constexpr std::int64_t kWallTwinAge_us = 15'000;
// A track that has not been sound for so long gives way to an evident puck, trusted or not.
constexpr std::int64_t kUnsoundFor_us = 150'000;
// A bounce or a mallet that passes is over sooner.
constexpr std::int64_t kBadFor_us = 20'000;
// A track from which the puck has gone has lost its events before that.
constexpr std::int64_t kDesertedFor_us = 2'000;
// Of what moves slower, noise makes too much.
constexpr double kSlow_px_s = 100;
// With fewer events nothing is seen clearly enough to be compared.
constexpr double kLeastStrength = 40;
// As for TrackLooks::is_clear: so many events make up for doubt. Fast pucks that came into view had
// thousands, what took over wrongly had 40 to 220.
constexpr double kUnmistakable = 300;
// A hand that only passes over the puck is gone sooner.
constexpr std::int64_t kTakenAway_us = 200'000;
// A puck that was sound so lately is still beneath what came over it, or beside it.
constexpr std::int64_t kSoundLately_us = 120'000;
// Of what the search found, most that is no puck has a lower score.
constexpr double kPossibleScore = 0.45;
// … and a part of a hand or a mallet one below this.
constexpr double kHardlySeen = 0.33;
// Of a puck more than this share of the directions is seen, unless something covers it.
constexpr double kFewSides = 0.35;
// A ring as good as that is more than a part of a mallet.
constexpr double kFineRing = 0.85;
// A trail that takes over has led so far. Clutter's seldom does.
constexpr int kFollowedFor = 8;
constexpr double kFollowed_px = 10;
// Of two that are seen alike, either may score as much more.
constexpr double kScoreNoise = 0.1;
// How far the puck may be from a track that has just been good, and how much farther it gets.
constexpr double kTakeoverRadius_px = 12;
constexpr double kTakeoverGrowth_px_us = 1.5e-3;
constexpr double kFarthestTakeover_px = 60;

// The clearer it is, the sooner.
bool has_had_time(const Claim& claim) {
  return claim.age_us > 6'000 ||
         (claim.age_us > 3'000 && claim.looks.quality > 0.9 && claim.looks.strength > 40);
}

// The head turns, and it is known how.
bool is_seen_turning(const Claim& claim) { return claim.own_speed_px_s.has_value(); }

// Edges that cross have events on few sides, and not so many.
bool is_more_than_edges(const TrackLooks& looks) {
  return looks.is_whole_ring() || looks.is_very_strong();
}

// To searches the main track looks more like a puck.
bool is_outscored(const Claim& claim, const Defence& main) {
  return main.knows_pucks && claim.found.score < main.score - kScoreNoise;
}

// The main track moves as nothing but a puck does, and the claim does not. In the image a round
// mark is the better ring of the two as long as the head turns.
bool is_only_round(const Claim& claim, const Defence& main) {
  return !claim.looks.is_fast() && main.looks.moves_as_pucks_do() &&
         main.since_sound_us < kBadFor_us;
}

// The main track moves, and has more events, on more sides, and is more of a puck to searches.
bool is_lesser(const Claim& claim, const Defence& main) {
  return main.knows_pucks && main.looks.is_good() && main.looks.is_fast() &&
         claim.looks.strength < main.looks.strength / 2 && claim.looks.cover < main.looks.cover &&
         claim.found.score < main.score;
}

// A faint puck is seen all around.
bool is_faint_ring(const Defence& main) {
  return main.knows_pucks && main.may_be_faint && main.looks.is_good() &&
         main.looks.is_whole_ring();
}

// Of what lies beside a faint puck, an arm's edge or a rail has events on few sides, and is hardly
// seen as a puck.
bool is_hardly_there(const Claim& claim, const Defence& main) {
  return main.knows_pucks && main.may_be_faint && claim.looks.cover < kFewSides &&
         claim.found.score < kPossibleScore;
}

}  // namespace

bool wins_test(Challenger::Kind kind, const Claim& claim) {
  switch (kind) {
    case Challenger::Kind::kTwin:
      return claim.age_us > kTwinAge_us && claim.leads;
    case Challenger::Kind::kWitness:
      return claim.age_us > kWitnessAge_us && claim.leads;
    case Challenger::Kind::kWall:
      // A ring that has grown beyond a puck's size explains more events, whatever they are of.
      return claim.age_us > kWallTwinAge_us && claim.leads && claim.looks.is_good() &&
             !claim.looks.is_oversized();
    case Challenger::Kind::kSearch:
      break;
  }
  return false;
}

bool is_evident(const Claim& claim) {
  return claim.found.score > kEvidentScore && claim.age_us > 5'000 && claim.looks.quality > 0.65 &&
         claim.looks.strength > 10;
}

bool moves_by_itself(const Claim& claim) {
  const TrackLooks& looks = claim.looks;
  if (claim.age_us <= 12'000 || looks.quality <= 0.75 || !looks.is_strong()) return false;
  // A hand or a mallet may be slow as well.
  const bool is_slow_puck =
      claim.context.head_rests && looks.speed_px_s > kSlow_px_s && looks.is_whole_ring();
  return is_slow_puck || looks.moves_as_pucks_do();
}

bool outshines(const Claim& claim, const Defence& main) {
  return claim.age_us > 10'000 && claim.looks.quality > 0.75 && claim.looks.strength > 40 &&
         (!main.knows_pucks || claim.found.score > kHardlySeen) &&
         claim.looks.strength > 3 * std::max(main.looks.strength, 5.0) &&
         (main.since_sound_us > kUnsoundFor_us || is_evident(claim));
}

bool surpasses(const Claim& claim, const Defence& main) {
  const TrackLooks& looks = claim.looks;
  const double handicap = main.looks.has_pucks_size() ? 0 : 0.2;
  return main.knows_pucks && claim.age_us > 15'000 && claim.leads && looks.is_fast() &&
         looks.is_whole_ring() && looks.has_pucks_size() && looks.is_good() &&
         looks.quality > main.looks.quality - handicap &&
         (claim.found.score > kPossibleScore || looks.quality > kFineRing) &&
         looks.strength > 1.5 * std::max(main.looks.strength, kLeastStrength) &&
         looks.cover > main.looks.cover && claim.found.score > main.score;
}

bool outmoves(const Claim& claim, const Defence& main) {
  // A puck that has hardly moved yet looks good, and clutter may be ring enough for a moment.
  if (!claim.leads && main.looks.is_good() && main.since_sound_us < kBadFor_us) return false;
  const bool has_gone_bad = main.may_be_overtaken && main.since_good_us > kBadFor_us;
  // A round mark may be as good a ring as there is, a mallet or a hand is none.
  const bool is_ring = claim.looks.is_whole_ring();
  return (!main.is_proven || has_gone_bad) && moves_by_itself(claim) &&
         claim.looks.quality > main.looks.quality - (is_ring ? 0.2 : 0.1) &&
         (is_ring || !is_outscored(claim, main));
}

bool unmasks(const Claim& claim, const Defence& main) {
  // A hand or a mallet that moves is clear at once, but no ring.
  const bool is_clear =
      is_clear_at_once(claim) && (claim.looks.is_whole_ring() || !is_faint_ring(main));
  return (is_evident(claim) || is_clear) && claim.looks.quality > main.looks.quality + 0.1 &&
         !is_only_round(claim, main) && !is_outscored(claim, main) &&
         (!main.is_trusted || main.since_sound_us > kUnsoundFor_us);
}

bool displaces_stranger(const Claim& claim, const Defence& main) {
  const TrackLooks& looks = claim.looks;
  return !main.is_trusted && !is_outscored(claim, main) && !is_only_round(claim, main) &&
         claim.age_us > 15'000 && looks.quality > 0.8 && looks.strength > 20 &&
         (!is_seen_turning(claim) || is_more_than_edges(looks)) && !looks.is_oversized() &&
         !looks.is_undersized() &&
         (looks.quality > main.looks.quality + 0.12 || looks.strength > 2 * main.looks.strength);
}

bool succeeds_nearby(const Claim& claim, const Defence& main) {
  const TrackLooks& looks = claim.looks;
  if (main.is_witnessed || is_outscored(claim, main) || looks.is_oversized()) return false;
  if (is_hardly_there(claim, main)) return false;
  const double reach_px = std::min(
      kFarthestTakeover_px,
      kTakeoverRadius_px + kTakeoverGrowth_px_us * static_cast<double>(main.since_good_us));
  const double away_px = distance_px(looks.position, main.looks.position);
  const double least_quality = 0.5 + 0.3 * away_px / kFarthestTakeover_px;
  if (claim.age_us <= 6'000 || looks.quality <= least_quality || looks.strength <= 10 ||
      looks.quality <= main.looks.quality + 0.1 || away_px > reach_px) {
    return false;
  }
  if (main.looks.quality < 0.35 && main.looks.strength < std::max(15.0, looks.strength / 2)) {
    return true;
  }
  return looks.strength > 1.3 * main.looks.strength && claim.leads;
}

bool inherits(const Claim& claim, const Defence& main) {
  const TrackLooks& looks = claim.looks;
  const bool has_lost_all = main.since_good_us > kDesertedFor_us &&
                            main.since_good_us <= kBadFor_us && main.looks.quality < 0.2 &&
                            main.looks.strength < looks.strength / 4;
  return main.knows_pucks && has_lost_all && claim.leads && looks.is_fast() &&
         looks.quality > 0.8 && looks.strength > 15 && looks.cover > 0.4 &&
         looks.has_pucks_size() && claim.found.score > kPossibleScore &&
         distance_px(looks.position, main.looks.position) < kFarthestTakeover_px;
}

bool outruns_rest(const Claim& claim, const Defence& main) {
  const bool may_be_gone = main.may_be_overtaken && main.was_covered &&
                           main.since_good_us > kTakenAway_us && claim.looks.is_whole_ring();
  return (main.may_be_faint || !main.is_proven || may_be_gone) && moves_by_itself(claim) &&
         claim.looks.quality > (claim.looks.is_whole_ring() ? 0.78 : 0.85) &&
         claim.looks.strength > kLeastStrength;
}

bool unsettles(const Claim& claim, const Defence& main) {
  const bool is_more_of_a_puck = claim.found.score > main.score + kScoreNoise;
  // While the puck is seen to lie there, what is no ring is a hand or a mallet that comes for it.
  const bool has_set_off =
      is_clear_at_once(claim) && (!main.looks.is_good() || claim.looks.is_whole_ring());
  return (is_evident(claim) && is_more_of_a_puck) || has_set_off || outruns_rest(claim, main);
}

bool is_recognised(const Claim& claim, const Defence& main) {
  const TrackLooks& looks = claim.looks;
  const double score = claim.found.score;
  if (!main.knows_pucks || main.since_good_us <= kBadFor_us) return false;
  if (is_clear_at_once(claim)) return true;
  if (!claim.leads || !has_had_time(claim) || looks.quality <= 0.5 || looks.strength <= 10 ||
      looks.cover <= 0.4 || looks.is_oversized() || looks.is_undersized()) {
    return false;
  }
  const bool is_possible = score > kPossibleScore && looks.speed_px_s > kSlow_px_s;
  return support(claim) > 1.7 && (is_possible || score > kLikelyScore);
}

bool is_premature(const Claim& claim, const Defence& main) {
  return main.knows_pucks && main.had_contrast && main.is_trusted && main.is_proven &&
         main.was_covered && main.since_sound_us < kSoundLately_us &&
         claim.found.score <= kPossibleScore && !is_clear_at_once(claim);
}

bool is_out_of_reach(const Claim& claim, const Defence& main) {
  const TrackLooks& looks = claim.looks;
  if (!main.had_contrast || !main.way_back || main.way_back->contains(looks.position)) return false;
  const bool is_fast_puck = looks.moves_as_pucks_do() && looks.is_whole_ring() &&
                            looks.strength > kUnmistakable &&
                            main.way_back->may_lead_to(looks.position, looks.speed_px_s);
  return !is_evident(claim) && !is_fast_puck;
}

bool is_followed(const Claim& claim, const Defence& main) {
  const TrackLooks& looks = claim.looks;
  const SightingTrail& trail = claim.found.trail;
  const bool has_some_events =
      looks.quality > 0.35 && looks.strength > 5 && !looks.is_oversized() && !looks.is_undersized();
  return main.may_be_faint && main.since_good_us > kBadFor_us &&
         (trail.is_certain() || (trail.is_steady() && trail.sightings >= kFollowedFor &&
                                 trail.own_px > kFollowed_px && has_some_events));
}

bool is_convincing(const Claim& claim, const Defence& main) {
  if (is_premature(claim, main) || is_out_of_reach(claim, main)) return false;
  if (claim.found.is_conjecture && !moves_by_itself(claim) &&
      main.since_sound_us <= kUnsoundFor_us) {
    return false;
  }
  // Whatever makes events is stronger than a puck at rest, a mallet as well.
  if (main.is_resting && (main.is_proven || main.is_trusted)) {
    return is_evident(claim) || outruns_rest(claim, main) ||
           (is_recognised(claim, main) && (main.is_lost || claim.found.score > kLikelyScore));
  }
  if (main.lies_in_scene && !main.is_lost) return unsettles(claim, main);
  if (is_lesser(claim, main)) return succeeds_nearby(claim, main);
  return is_recognised(claim, main) || outshines(claim, main) || surpasses(claim, main) ||
         outmoves(claim, main) || unmasks(claim, main) || displaces_stranger(claim, main) ||
         succeeds_nearby(claim, main) || inherits(claim, main) || is_followed(claim, main);
}

bool is_convincing_as_first(const Claim& claim, std::int64_t searched_us) {
  // A round mark on the table has no side wall; the puck has the one that the calibration knows.
  const bool is_like_a_mark = claim.has_other_wall && searched_us <= kPatience_us;
  const TrackLooks& looks = claim.looks;
  const bool may_turn = claim.context.head_may_turn;
  // What is very strong is no edge.
  if (may_turn && searched_us <= kLongPatience_us &&
      ((looks.may_slide() && !looks.is_very_strong()) || is_adrift(claim))) {
    return false;
  }
  // Hands and mallets move as well; and so, while the head turns, do edges that cross.
  const bool moves_as_first = moves_by_itself(claim) && !looks.is_large() && !looks.may_slide() &&
                              (!may_turn || is_more_than_edges(looks));
  return ((is_evident(claim) || may_be_printed(claim)) && !is_like_a_mark) ||
         (is_likely(claim) && !(may_turn && looks.is_covered())) || moves_as_first ||
         (searched_us > kPatience_us &&
          (rests_in_scene(claim) || (claim.age_us > 20'000 && looks.quality > 0.8 &&
                                     looks.strength > 30 && looks.is_whole_ring())));
}

bool is_weakly_found(const Claim& claim, const std::optional<TrackLooks>& main) {
  const bool is_near =
      main && distance_px(main->position, claim.looks.position) < kFarthestTakeover_px;
  return !is_near && !is_evident(claim) && !moves_by_itself(claim) && !is_clear_at_once(claim) &&
         !is_likely(claim) && !rests_in_scene(claim) && !claim.found.trail.is_certain();
}

}  // namespace puck
