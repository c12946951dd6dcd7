#pragma once

#include "common/simulation/puck_physics.h"
#include "common/simulation/simulated_truth.h"

namespace puck {

/// Counts the true shots, saves and goals. A hit is one contact of a mallet with the puck, or
/// several within 10 ms; it is judged when it is over, by where the puck would go if not touched
/// again:
/// - a shot is a hit of the opponent that would enter the robot's goal,
/// - a save is a shot that the robot's mallet touched and that then would not enter.
/// A shot that the opponent touches again, and that then would not enter, is neither save nor goal.
class Referee {
 public:
  explicit Referee(const PuckPhysics& physics);

  // Call at each contact, with the puck's state just before it.
  void opponent_touched(const DiscState& before, double t_s);
  void robot_touched(const DiscState& before, double t_s);
  /// The puck was deflected by something other than a mallet: a shot that it turned away no longer
  /// counts, also not as a save.
  void puck_deflected(const DiscState& after);
  /// Call once a step, with the puck's state after the step.
  void watch(const DiscState& puck, double t_s);
  /// The puck entered a goal, or with kNone was taken off the table.
  void puck_left(const DiscState& puck, GoalEntered goal);

  const GameCounts& counts() const { return counts_; }

 private:
  enum class Hit { kNone, kOpponents, kRobots };

  void judge(const DiscState& puck);

  PuckPhysics physics_;
  GameCounts counts_;
  bool shot_under_way_ = false;
  Hit open_hit_ = Hit::kNone;  ///< The hit that is not judged yet.
  double last_contact_s_ = 0;
};

}  // namespace puck
