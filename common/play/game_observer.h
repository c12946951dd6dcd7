#pragma once

#include <cstdint>
#include <optional>

#include "common/events/timestamp.h"
#include "common/messaging/channels.h"
#include "common/table/puck_motion.h"
#include "common/table/puck_track.h"

namespace puck {

/// As game_state_t numbers them.
enum class GamePhase : std::int8_t {
  kWaiting = game_state_t::PHASE_WAITING,
  kRally = game_state_t::PHASE_RALLY,
  kShotAtRobot = game_state_t::PHASE_SHOT_AT_ROBOT,
  kGoal = game_state_t::PHASE_GOAL,
  kPuckStuck = game_state_t::PHASE_PUCK_STUCK,
  kPuckOutOfView = game_state_t::PHASE_PUCK_OUT_OF_VIEW,
};

/// The game as it looks from the puck's track alone.
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

/// Follows the game: a shot is a puck on its way into the robot's goal; a save, when it turns back
/// or aside; a goal, when it vanishes on its way into one. One thread.
class GameObserver {
 public:
  explicit GameObserver(const PuckMotion& motion) : motion_(motion) {}

  /// The puck as it is tracked at `t`. Times must not go back, except after `forget_time`.
  void see(Timestamp t, const PuckTrack& track);
  /// The puck is not seen at `t`.
  void miss(Timestamp t);
  /// The sensor's time begins anew; the score stays.
  void forget_time();

  const GameBelief& belief() const { return belief_; }

 private:
  enum class Heading { kNone, kToRobot, kToOpponent };
  enum class Goal { kNone, kRobots, kOpponents };

  Goal goal_ahead(const PuckTrack& track) const;
  void follow_heading(double vx_m_s);
  void follow_shot(Timestamp t, const PuckTrack& track);
  void end_rally();
  void enter(GamePhase phase, Timestamp t);

  PuckMotion motion_;
  GameBelief belief_;
  std::optional<Timestamp> last_seen_;
  std::optional<Timestamp> slow_since_;
  PuckTrack last_track_;
  Heading heading_ = Heading::kNone;
  bool shot_open_ = false;
  std::optional<Timestamp> aimed_since_;   // has been on its way into the robot's goal since
  std::optional<Timestamp> astray_since_;  // an open shot that has not been since
};

}  // namespace puck
