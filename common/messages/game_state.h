#pragma once

#include <cstdint>

#include "common/events/timestamp.h"
#include "common/messages/message_header.h"

namespace puck {

/// As GAME numbers them.
enum class GamePhase : std::int8_t {
  kWaiting,
  kRally,
  kShotAtRobot,
  kGoal,
  kPuckStuck,
  kPuckOutOfView,
};

/// State of the game as estimated from the puck's track alone.
struct GameBelief {
  GamePhase phase = GamePhase::kWaiting;
  Timestamp phase_since;
  std::int32_t goals_for = 0;
  std::int32_t goals_against = 0;
  std::int32_t rally_hits = 0;
  std::int32_t longest_rally = 0;
  std::int32_t shots = 0;
  std::int32_t saves = 0;

  friend bool operator==(const GameBelief&, const GameBelief&) = default;
};

/// GAME: the bridge's belief.
struct GameState : MessageHeader, GameBelief {
  Timestamp at;
};

}  // namespace puck
