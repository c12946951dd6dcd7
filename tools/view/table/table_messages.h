#pragma once

#include "common/messaging/channels.h"
#include "tools/view/interface/view_scene.h"

namespace puck {

/// Updates the table's picture by a message, whose arrays are as long as their counts say. Each
/// sets only what its channel tells.
void take(const puck_trajectory_t& trajectory, ViewTable& table);
void take(const game_state_t& game, ViewTable& table);
void take(const arm_state_t& arm, ViewTable& table);
void take(const arm_command_t& command, ViewTable& table);
void take(const ground_truth_t& truth, ViewTable& table);

}  // namespace puck
