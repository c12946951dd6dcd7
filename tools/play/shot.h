#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

#include "common/play/game_observer.h"
#include "tools/play/play_setup.h"
#include "tools/play/shot_facts.h"

namespace puck {

/// Cause of a goal: the first of these that applies.
enum class GoalCause : std::uint8_t {
  kNotReachable,  ///< Out of reach for the best arm.
  kNotTracked,    ///< A track for less than 70 % of the time from the hit to the crossing.
  kMispredicted,  ///< The last command before the crossing was more than 4 cm off.
  kLate,          ///< The mallet was more than 4 cm off that correct command.
  kDeflected,     ///< The puck went in although the mallet was there.
};
inline constexpr std::size_t kGoalCauses = 5;
/// `not_reachable`, `not_tracked`, …
std::string_view to_string(GoalCause cause);

/// The result of one shot.
struct ShotOutcome {
  enum class End : std::uint8_t { kSaved, kGoal, kUnjudged };
  End end = End::kUnjudged;
  std::optional<GoalCause> cause;  ///< Of a goal.
  double tracked_share = 0;        ///< Share of the time from the hit to the crossing.
  double command_error_m = 0;      ///< The last command before the crossing, minus the truth.
  double mallet_error_m = 0;       ///< The mallet at the crossing, minus the truth.
  /// Time from the hit until all further commands are within 4 cm of the truth.
  std::optional<std::int64_t> settled_us;
  GameBelief belief;           ///< At the end.
  std::int64_t played_us = 0;  ///< Sensor time.
};

/// Plays the shot in the closed loop: from the start of the game until it is judged and the bridge
/// has had time to notice.
ShotOutcome play_shot(const PlaySetup& setup, const ShotFacts& facts);

}  // namespace puck
