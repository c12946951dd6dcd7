#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "common/play/game_observer.h"
#include "tools/play/play_setup.h"
#include "tools/play/shot_facts.h"

namespace puck {

/// Why a shot went in: the first of these that holds.
enum class GoalCause : std::uint8_t {
  kNotReachable,  ///< Not even an arm that knew everything at once could save it.
  kNotTracked,  ///< For less than 70 % of the time from the hit to the crossing there was a track.
  kMispredicted,  ///< The last command before the crossing was more than 4 cm off.
  kLate,          ///< That was right, but the mallet was not there yet: more than 4 cm off.
  kDeflected,     ///< The mallet was there, and the puck went in all the same.
};
inline constexpr std::size_t kGoalCauses = 5;
/// `not_reachable`, `not_tracked`, …
std::string_view to_string(GoalCause cause);

/// What became of one shot.
struct ShotOutcome {
  enum class End : std::uint8_t { kSaved, kGoal, kUnjudged };
  End end = End::kUnjudged;
  std::optional<GoalCause> cause;  ///< Of a goal.
  double tracked_share = 0;        ///< Of the time from the hit to the crossing.
  double command_error_m = 0;      ///< The last command before the crossing, minus the truth.
  double mallet_error_m = 0;       ///< The mallet at the crossing, minus the truth.
  /// From the hit to the first command of which all later ones were within 4 cm of the truth.
  std::optional<std::int64_t> settled_us;
  GameBelief belief;           ///< The bridge's, at the end.
  std::int64_t played_us = 0;  ///< Sensor time.
};

/// Plays the shot in the closed loop: from the game's start until it has been judged, and then on
/// until the bridge must have noticed, too.
ShotOutcome play_shot(const PlaySetup& setup, const ShotFacts& facts);

}  // namespace puck
