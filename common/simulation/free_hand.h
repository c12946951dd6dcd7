#pragma once

#include <optional>

#include "common/simulation/game_params.h"
#include "common/simulation/puck_physics.h"
#include "common/simulation/random.h"
#include "common/simulation/vector3.h"

namespace puck {

/// The opponent's other hand. With a given probability, when the puck comes to the opponent, it
/// reaches between puck and camera, hides the puck for a while, and goes back.
class FreeHand {
 public:
  /// `eye`: the camera's centre.
  FreeHand(const TableGeometry& table, const GameParams& params, Vector3 eye, Random random);

  void step(const std::optional<DiscState>& puck, double dt_s);

  /// While true, the opponent does not strike.
  bool is_hiding() const { return hide_s_ > 0; }
  /// The middle of the hand; `std::nullopt` while it is away.
  const std::optional<Vector3>& place() const { return place_; }
  Vector3 velocity_m_s() const { return velocity_m_s_; }

 private:
  Vector3 hiding_place(TablePoint puck) const;
  /// Follows a target of velocity `target_m_s`.
  void move_towards(Vector3 target, Vector3 target_m_s, double dt_s);

  TableGeometry table_;
  GameParams params_;
  Vector3 eye_;
  Random random_;
  bool puck_is_here_ = false;
  double hide_s_ = 0;  ///< Remaining time for which it hides the puck.
  std::optional<Vector3> place_;
  Vector3 velocity_m_s_;
};

}  // namespace puck
