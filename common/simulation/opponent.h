#pragma once

#include <cstdint>
#include <optional>

#include "common/simulation/game_params.h"
#include "common/simulation/puck_physics.h"
#include "common/simulation/random.h"
#include "common/simulation/shot_planner.h"

namespace puck {

/// A player at the far end: guards the goal, waits for the puck, strikes it at the robot's goal,
/// and goes back.
class Opponent {
 public:
  Opponent(const PuckPhysics& physics, const GameParams& params, std::int64_t seed);

  enum class Conduct : std::uint8_t {
    kPlays,
    kLeavesAlone,  ///< No swing starts; the mallet guards the goal.
    kServes,       ///< No swing starts; the mallet goes to home() and waits.
  };

  /// Moves the mallet; `puck` is `std::nullopt` while none is in play.
  void step(const std::optional<DiscState>& puck, double dt_s, Conduct conduct);

  const DiscState& mallet() const { return mallet_; }
  /// Where the mallet waits while no puck is in play: in front of the goal's middle.
  TablePoint home() const;
  bool is_home() const;

 private:
  /// A mallet's path to a given position and velocity: a cubic in time.
  struct Swing {
    DiscState from;
    DiscState to;
    double duration_s = 0;
    double elapsed_s = 0;

    DiscState at(double t_s) const;
  };

  void guard(const std::optional<DiscState>& puck, double dt_s);
  void follow_swing(double dt_s);
  std::optional<Swing> plan(const DiscState& puck) const;
  bool is_clear(const Swing& swing, const DiscState& puck) const;
  void keep_on_table();

  PuckPhysics physics_;
  GameParams params_;
  Random random_;
  ShotPlanner planner_;
  DiscState mallet_;
  std::optional<Swing> swing_;
  double strike_in_s_ = 0;  ///< Remaining wait before the next strike is planned.
  bool puck_is_here_ = false;
};

}  // namespace puck
