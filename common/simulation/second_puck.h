#pragma once

#include "common/simulation/puck_physics.h"
#include "common/simulation/random.h"

namespace puck {

/// A puck that takes no part in the game: it glides about at a speed of its own, bounces off rails,
/// closed goals, mallets and the puck in play, and never stops.
class SecondPuck {
 public:
  /// `speed_m_s`: more than 0.
  SecondPuck(const TableGeometry& table, const PhysicsParams& params, double speed_m_s,
             Random random);

  /// Moves on by PuckPhysics::kStep_s.
  void step(const DiscState& robot, const DiscState& opponent);
  /// Keeps it and the puck in play apart and bounces them off each other; true when they touched.
  bool collide(DiscState& puck);

  const DiscState& state() const { return state_; }

 private:
  PuckPhysics physics_;
  double speed_m_s_;
  DiscState state_;
};

}  // namespace puck
