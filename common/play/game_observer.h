#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "common/events/timestamp.h"
#include "common/messaging/channels.h"
#include "common/play/hit_finder.h"
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

/// Follows the game from the puck's track alone. As a referee has it, a shot is a hit of the
/// opponent's that would enter the robot's goal, and a save is a shot that the robot's mallet hit
/// and that then would not; a goal is a puck that vanishes in one or on its way into it. Counts a
/// shot once it has come into the robot's half and the prediction is sure of it. One thread.
class GameObserver {
 public:
  explicit GameObserver(const PuckMotion& motion) : motion_(motion), hits_(motion) {}

  /// The puck as it is tracked at `t`. Times must not go back, except after `forget_time`.
  void see(Timestamp t, const PuckTrack& track);
  /// The puck is not seen at `t`.
  void miss(Timestamp t);
  /// The sensor's time begins anew; the score stays.
  void forget_time();

  const GameBelief& belief() const { return belief_; }

 private:
  enum class Goal { kNone, kRobots, kOpponents };
  // Where the puck goes if nobody touches it.
  struct Outlook {
    Goal near = Goal::kNone;  // the goal that it enters, or misses by little
    bool enters = false;
    bool is_sure = false;  // of what `enters` says
    double in_s = 0;       // until then

    bool is_shot() const { return enters && near == Goal::kRobots; }
  };

  Outlook look_ahead(const PuckTrack& track) const;
  Goal goal_around(const TablePoint& place) const;
  bool is_in_goal(const PuckTrack& track) const;
  double time_to_end(const PuckState& state) const;
  std::pair<double, double> beside_posts(double y_m, TableVelocity velocity) const;
  void follow_hits(Timestamp t, const PuckTrack& track);
  void follow_shot(Timestamp t, const PuckTrack& track);
  void decide_attack(bool enters);
  void save();
  void end_rally();
  void enter(GamePhase phase, Timestamp t);

  PuckMotion motion_;
  HitFinder hits_;
  GameBelief belief_;
  std::optional<Timestamp> last_seen_;
  std::optional<Timestamp> slow_since_;
  PuckTrack last_track_;
  Outlook outlook_;           // of the last track
  bool attack_open_ = false;  // the opponent has hit the puck: it may be a shot
  Timestamp attack_since_;
  bool shot_open_ = false;                   // it was one, and is under way
  bool shot_touched_ = false;                // by the robot's mallet
  bool threat_ = false;                      // the phase is that of a shot
  std::optional<Timestamp> changing_since_;  // it should not be, or should, since
  double nearest_m_ = 0;                     // to the robot's end, of an open shot
  std::optional<Timestamp> astray_since_;    // a touched shot would miss since
};

}  // namespace puck
