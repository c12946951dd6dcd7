#pragma once

#include <cstdint>
#include <optional>

#include "puck/arm_state_t.hpp"
#include "puck/game_state_t.hpp"
#include "puck/ground_truth_t.hpp"
#include "puck/puck_trajectory_t.hpp"
#include "tools/view/interface/view_scene.h"

namespace puck {

/// The game on the table, from the newest messages of the bridge, the arm and the simulated world.
/// Times are CLOCK_MONOTONIC, µs. One thread.
class LiveTable {
 public:
  void take(const puck_trajectory_t& trajectory, std::int64_t now_us) {
    trajectory_ = {trajectory, now_us};
  }
  void take(const arm_state_t& state, std::int64_t now_us) { arm_ = {state, now_us}; }
  void take(const game_state_t& game, std::int64_t now_us) { game_ = {game, now_us}; }
  void take(const ground_truth_t& truth, std::int64_t now_us) { truth_ = {truth, now_us}; }

  /// Empty before any of these messages. Leaves out what was not repeated for half a second.
  std::optional<ViewTable> table(std::int64_t now_us) const;

 private:
  template <typename Message>
  struct Newest {
    std::optional<Message> message;
    std::int64_t time_us = 0;
  };

  Newest<puck_trajectory_t> trajectory_;
  Newest<arm_state_t> arm_;
  Newest<game_state_t> game_;
  Newest<ground_truth_t> truth_;
};

}  // namespace puck
