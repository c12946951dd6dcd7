#pragma once

#include <cstdint>
#include <optional>

#include "common/vision/background.h"
#include "common/vision/challenger.h"
#include "common/vision/track_looks.h"

namespace puck {

/// What is the same for all claims at a decision.
struct ClaimContext {
  bool head_rests = false;  ///< Background's: whatever moves in the image moves by itself.
  bool at_once = true;      ///< Ingredient `at-once`.
  bool own_motion = true;   ///< Ingredient `own-motion`.
  /// Says how what stands still moves; null: nothing does.
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

/// What speaks for it as of its last decision.
Claim claim_of(const Challenger& challenger, const ClaimContext& context, std::int64_t time_us);

/// What speaks for a claim: its events by at most 1, the search by at most 2.
inline double support(const Claim& claim) { return claim.looks.quality + 2 * claim.found.score; }

/// Ingredient `at-once`. It moves, leads, and its events, few as they may be, lie on a puck's ring
/// and hardly anywhere else; or so many lie there that others may lie beside it. The better it
/// looked to the search, the fewer will do. That they cover only a part of the ring says nothing: a
/// puck may come out from behind something.
bool is_clear_at_once(const Claim& claim);

/// So strong that the edge of a tile or of an arm hardly ever is.
inline bool stands_out(const Claim& claim) { return claim.looks.strength > 80; }

/// Ingredient `own-motion`. It moves neither with the scene of a turning head, as a puck at rest
/// does, nor as clearly by itself as a puck that was hit: it may slide along an edge.
bool is_adrift(const Claim& claim);

/// Ingredient `at-once`. A whole ring that need not move: its events and the search's score
/// together say that it is the puck, though neither does so beyond doubt.
bool is_likely(const Claim& claim);

}  // namespace puck
