#pragma once

#include <cstdint>

#include "common/simulation/physics_params.h"
#include "common/table/table_geometry.h"
#include "common/table/table_point.h"

namespace puck {

/// A disc on the table: the puck or a mallet.
struct DiscState {
  TablePoint position;
  TableVelocity velocity;
};

enum class GoalEntered { kNone, kRobots, kOpponents };

/// How the puck moves in the simulated world: gliding with damping, bouncing off rails, goal posts
/// and mallets.
class PuckPhysics {
 public:
  /// The world's time step. At 15 m/s the puck moves 0.4 mm in it, so that it cannot tunnel through
  /// a rail or mallet.
  static constexpr std::int64_t kStep_us = 25;
  static constexpr double kStep_s = kStep_us / 1e6;

  PuckPhysics(const TableGeometry& table, const PhysicsParams& params);

  /// Moves the puck on by `dt_s` with no mallet in its way.
  void glide(DiscState& puck, double dt_s) const;
  /// Separates puck and mallet and bounces the puck off; true when they touched. The mallet has
  /// infinite mass.
  bool hit(DiscState& puck, const DiscState& mallet) const;
  /// The goal that contains the puck's whole disc.
  GoalEntered goal_of(const DiscState& puck) const;
  /// Whether the puck, if not touched again, enters the robot's goal before it turns back.
  bool would_enter_robots_goal(DiscState puck) const;

  const TableGeometry& table() const { return table_; }
  const PhysicsParams& params() const { return params_; }

 private:
  void bounce_off_end(double& distance_m, double& away_m_s, DiscState& puck) const;

  TableGeometry table_;
  PhysicsParams params_;
};

}  // namespace puck
