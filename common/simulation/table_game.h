#pragma once

#include <cstdint>
#include <optional>

#include "common/simulation/free_hand.h"
#include "common/simulation/opponent.h"
#include "common/simulation/puck_physics.h"
#include "common/simulation/puck_rest.h"
#include "common/simulation/puck_serve.h"
#include "common/simulation/random.h"
#include "common/simulation/referee.h"
#include "common/simulation/second_puck.h"
#include "common/simulation/simulated_arm.h"
#include "common/simulation/simulation_params.h"

namespace puck {

/// Everything that moves on the table: the puck, the two players, and the rules.
class TableGame {
 public:
  explicit TableGame(const SimulationParams& params);

  /// Advances the game by PuckPhysics::kStep_s.
  void step();

  /// As SimulatedTable::set_robot_mallet.
  void set_robot_mallet(double y_m);
  /// Places the puck with the given position and velocity.
  void place_puck(const DiscState& puck);

  /// `std::nullopt` while the puck is off the table.
  const std::optional<DiscState>& puck() const { return puck_; }
  const DiscState& robot_mallet() const { return robot_; }
  const DiscState& opponent_mallet() const { return opponent_.mallet(); }
  /// `std::nullopt` unless the game has a second puck.
  const std::optional<SecondPuck>& second_puck() const { return second_puck_; }
  const FreeHand& free_hand() const { return free_hand_; }
  const GameCounts& counts() const { return referee_.counts(); }

 private:
  void move_robot();
  void plan_robot_move();
  void move_puck();
  Opponent::Conduct opponents_conduct() const;
  bool is_paused() const {
    return serve_.is_under_way() || rest_.is_on() || free_hand_.is_hiding();
  }
  bool is_stuck();
  void take_puck_off(GoalEntered goal);
  TablePoint place_to_serve();
  void serve();
  double time_s() const { return static_cast<double>(steps_) * PuckPhysics::kStep_s; }

  PuckPhysics physics_;
  GameParams params_;
  bool autonomous_robot_;
  Random random_;
  Opponent opponent_;
  FreeHand free_hand_;
  PuckRest rest_;
  Referee referee_;
  SimulatedArm arm_;
  DiscState robot_;
  double robot_target_y_m_ = 0;
  std::optional<DiscState> puck_;
  PuckServe serve_;
  std::optional<SecondPuck> second_puck_;
  std::int64_t steps_ = 0;
  double off_since_s_ = 0;
  double last_moving_s_ = 0;  ///< Last time the puck moved.
  double last_attack_s_ = 0;  ///< Last serve or hit by the opponent.
};

}  // namespace puck
