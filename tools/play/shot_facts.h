#pragma once

#include <cstdint>

#include "common/events/timestamp.h"
#include "tools/play/play_setup.h"

namespace puck {

/// The first hit of a game, as it truly was, and whether an arm that knew at once where the puck
/// will cross could save it.
struct ShotFacts {
  std::int64_t seed = 0;  ///< Of the game.
  bool is_shot = false;   ///< As the Referee counts; the rest is only then filled in.
  Timestamp hit;
  Timestamp crossing;       ///< When its rim would touch a mallet that stands in its way …
  double crossing_y_m = 0;  ///< … and where its centre is then.
  double speed_m_s = 0;     ///< Just after the hit.
  bool is_reachable = false;
  bool hits_waiting_mallet = false;  ///< A mallet that never leaves the middle saves it.
};

/// Plays the game's first shot with an arm that is the setup's but for this: from the hit on it is
/// sent, without delay, to where the puck truly crosses.
ShotFacts find_shot(const PlaySetup& setup, std::int64_t seed);

}  // namespace puck
