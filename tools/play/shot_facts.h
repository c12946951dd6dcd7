#pragma once

#include <cstdint>

#include "common/events/timestamp.h"
#include "tools/play/play_setup.h"

namespace puck {

/// The true first hit of a game, and whether an arm that knows the crossing at once could save it.
struct ShotFacts {
  std::int64_t seed = 0;  ///< Of the game.
  bool is_shot = false;   ///< By the Referee's rules; if false, the rest is not set.
  Timestamp hit;
  Timestamp crossing;       ///< When the rim would touch a mallet in its way …
  double crossing_y_m = 0;  ///< … and the centre's position then.
  double speed_m_s = 0;     ///< Just after the hit.
  bool is_reachable = false;
  bool hits_waiting_mallet = false;  ///< A mallet at rest in the middle saves it.
};

/// Plays the game's first shot with the setup's arm, sent to the true crossing from the hit on
/// without delay.
ShotFacts find_shot(const PlaySetup& setup, std::int64_t seed);

}  // namespace puck
