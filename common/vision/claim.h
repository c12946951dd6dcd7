#pragma once

#include <cstdint>
#include <optional>

#include "common/vision/challenger.h"
#include "common/vision/track_looks.h"

namespace puck {

class Background;

/// What is the same for all claims at a decision.
struct ClaimContext {
  bool head_rests = false;  ///< Background's: whatever moves in the image moves by itself.
  bool at_once = true;      ///< Ingredient `at-once`.
  bool face_print = true;   ///< Ingredient `face-print`.
  bool scene_rests = true;  ///< Ingredient `scene-rests`.
  /// Ingredient `own-motion`: the head is not known to rest, which takes 300 ms, so that what moves
  /// may stand still. False while the background is not consulted.
  bool head_may_turn = false;
  /// … and this says how what stands still moves; null: that is not known.
  const Background* background = nullptr;
};

/// What speaks for a challenger.
struct Claim {
  TrackLooks looks;
  std::int64_t age_us = 0;
  Challenger::Found found;
  bool leads = false;           ///< Challenger::leads.
  bool has_other_wall = false;  ///< Challenger::has_other_wall.
  /// How fast it moves against what stands still, px/s, while it is known how that moves.
  std::optional<double> own_speed_px_s;
  ClaimContext context;
};

/// What speaks for it as of its last decision; a trail only until it ends.
Claim claim_of(const Challenger& challenger, const ClaimContext& context, std::int64_t time_us);

/// Hardly anything that the search finds and that is no puck has a higher score.
inline constexpr double kLikelyScore = 0.6;

/// What speaks for a claim: its events by at most 1, the search by at most 2.
inline double support(const Claim& claim) { return claim.looks.quality + 2 * claim.found.score; }

/// Ingredient `at-once`. It moves, leads, and its events, few as they may be, lie on a puck's ring
/// and hardly anywhere else; or so many lie there that others may lie beside it. The better it
/// looked to the search, the fewer will do. That they cover only a part of the ring says nothing: a
/// puck may come out from behind something.
bool is_clear_at_once(const Claim& claim);

/// Ingredient `own-motion`. It does not move with the scene of a turning head, as a puck at rest
/// does, and may slide along an edge: it has not very many events, nor is it a whole ring that is
/// far faster than the scene. False while it is not known how the head turns.
bool is_adrift(const Claim& claim);

/// Ingredient `scene-rests`. A ring of a puck's size, most of the way around, that moves with the
/// scene of a turning head, as a puck at rest does. It need not have many events. A round mark is
/// such a ring, too. False while it is not known how the head turns.
bool rests_in_scene(const Claim& claim);

/// Ingredient `at-once`. A whole ring that need not move: its events and the search's score
/// together say that it is the puck, though neither does so beyond doubt.
bool is_likely(const Claim& claim);

/// Ingredient `face-print`. A ring of about a puck's size, with many events, nearly all around,
/// that stands out from what lies around it, though not from what lies inside, which may be a
/// print; and the search has hardly any doubt. It need not move.
bool may_be_printed(const Claim& claim);

}  // namespace puck
