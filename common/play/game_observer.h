#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "common/events/timestamp.h"
#include "common/messages/game_state.h"
#include "common/play/hit_finder.h"
#include "common/table/puck_motion.h"
#include "common/table/puck_track.h"

namespace puck {

/// Follows the game from the puck's track alone, by a referee's rules: a shot is a hit by the
/// opponent that would enter the robot's goal; a save is a shot that the robot's mallet hit and
/// that then would miss; a goal is a puck that vanishes in a goal or on its way into one. A shot
/// counts once it is in the robot's half and its prediction is certain. One thread.
class GameObserver {
 public:
  explicit GameObserver(const PuckMotion& motion) : motion_(motion), hits_(motion) {}

  /// The tracked puck at `t`. Times must not go back, except after `forget_time`.
  void see(Timestamp t, const PuckTrack& track);
  /// There is no tracked puck at `t`.
  void miss(Timestamp t);
  /// The sensor's time starts again; the score stays.
  void forget_time();

  const GameBelief& belief() const { return belief_; }

 private:
  enum class Goal { kNone, kRobots, kOpponents };
  // Prediction of an untouched puck.
  struct Outlook {
    Goal near = Goal::kNone;  // the goal that it enters or narrowly misses
    bool enters = false;
    bool is_sure = false;  // whether `enters` is certain
    double in_s = 0;       // time until then

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
  Outlook outlook_;           // prediction from the last track
  bool attack_open_ = false;  // the opponent's hit may become a shot
  Timestamp attack_since_;
  bool shot_open_ = false;                   // a shot is on its way
  bool shot_touched_ = false;                // it has touched the robot's mallet
  bool threat_ = false;                      // the phase is kShotAtRobot
  std::optional<Timestamp> changing_since_;  // start of a pending change of `threat_`
  double nearest_m_ = 0;                     // least distance of the shot to the robot's end
  std::optional<Timestamp> astray_since_;    // the touched shot would miss since then
};

}  // namespace puck
