#pragma once

#include <optional>

#include "common/simulation/game_params.h"
#include "common/simulation/puck_physics.h"
#include "common/simulation/random.h"

namespace puck {

/// With a given probability, when the puck comes to the opponent, lets it come to rest in the
/// middle of his half, where he can strike it well, and stay there for a while.
class PuckRest {
 public:
  PuckRest(const TableGeometry& table, const GameParams& params, Random random);

  /// Call once a step. Slows a puck that is to rest.
  void step(std::optional<DiscState>& puck, double dt_s);

  /// While true, the opponent must leave the puck alone.
  bool is_on() const { return is_on_; }

 private:
  bool is_in_reach(TablePoint place) const;

  TableGeometry table_;
  GameParams params_;
  Random random_;
  bool puck_is_here_ = false;
  bool is_on_ = false;
  double rest_s_ = 0;  ///< Remaining time at rest.
};

}  // namespace puck
