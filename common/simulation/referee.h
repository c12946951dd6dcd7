#pragma once

#include "common/simulation/puck_physics.h"
#include "common/simulation/simulated_truth.h"

namespace puck {

/// Counts shots, saves and goals as they really are. A hit is one contact of a mallet with the
/// puck, or several within 10 ms; it is judged when it is over, by where the puck would go if
/// nobody touched it again:
/// - a shot is a hit of the opponent that would enter the robot's goal,
/// - a save is a shot under way that the robot's mallet touched and that then would not enter.
/// A shot that the opponent touches again, and that then would not enter, is neither save nor goal.
class Referee {
 public:
  explicit Referee(const PuckPhysics& physics);

  // Each contact at the time it happens, with the puck as it was just before it.
  void opponent_touched(const DiscState& before, double t_s);
  void robot_touched(const DiscState& before, double t_s);
  /// Something that is no mallet has changed the puck's way: a shot that it turned away is none any
  /// more, and no save.
  void puck_deflected(const DiscState& after);
  /// Once a step, with the puck as it is after it.
  void watch(const DiscState& puck, double t_s);
  /// The puck has entered a goal, or with kNone has been taken off the table.
  void puck_left(const DiscState& puck, GoalEntered goal);

  const GameCounts& counts() const { return counts_; }

 private:
  enum class Hit { kNone, kOpponents, kRobots };

  void judge(const DiscState& puck);

  PuckPhysics physics_;
  GameCounts counts_;
  bool shot_under_way_ = false;
  Hit open_hit_ = Hit::kNone;  ///< Not judged yet.
  double last_contact_s_ = 0;
};

}  // namespace puck
