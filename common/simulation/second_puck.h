#pragma once

#include "common/simulation/puck_physics.h"
#include "common/simulation/random.h"

namespace puck {

/// A puck that is not part of the game: it glides at a constant speed, bounces off rails, closed
/// goals, mallets and the puck in play, and never stops.
class SecondPuck {
 public:
  /// `speed_m_s` must be more than 0.
  SecondPuck(const TableGeometry& table, const PhysicsParams& params, double speed_m_s,
             Random random);

  /// Advances by PuckPhysics::kStep_s.
  void step(const DiscState& robot, const DiscState& opponent);
  /// Separates the two pucks and bounces them off each other; true when they touched.
  bool collide(DiscState& puck);

  const DiscState& state() const { return state_; }

 private:
  PuckPhysics physics_;
  double speed_m_s_;
  DiscState state_;
};

}  // namespace puck
