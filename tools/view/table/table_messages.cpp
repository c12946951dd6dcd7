#include "tools/view/table/table_messages.h"

#include <algorithm>
#include <cstddef>

namespace puck {
namespace {

const char* phase_words(std::int8_t phase) {
  switch (phase) {
    case game_state_t::PHASE_WAITING:
      return "waiting";
    case game_state_t::PHASE_RALLY:
      return "rally";
    case game_state_t::PHASE_SHOT_AT_ROBOT:
      return "shot at the robot";
    case game_state_t::PHASE_GOAL:
      return "goal";
    case game_state_t::PHASE_PUCK_STUCK:
      return "puck is stuck";
    case game_state_t::PHASE_PUCK_OUT_OF_VIEW:
      return "puck is out of view";
    default:
      return "";
  }
}

}  // namespace

void take(const puck_trajectory_t& trajectory, ViewTable& table) {
  using Validity = ViewTable::Validity;
  table.validity = trajectory.validity == puck_trajectory_t::VALIDITY_TRACKED ? Validity::kTracked
                   : trajectory.validity == puck_trajectory_t::VALIDITY_COASTING
                       ? Validity::kCoasting
                       : Validity::kNone;
  table.puck.state = {{trajectory.x_m, trajectory.y_m}, {trajectory.vx_m_s, trajectory.vy_m_s}};
  table.puck.covariance = Matrix4(trajectory.covariance);
  table.path.clear();
  const std::size_t points = std::min(
      {trajectory.path_t_s.size(), trajectory.path_x_m.size(), trajectory.path_y_m.size()});
  for (std::size_t i = 0; i < points; ++i) {
    table.path.push_back(
        {trajectory.path_t_s[i], {trajectory.path_x_m[i], trajectory.path_y_m[i]}});
  }
  table.crossing.reset();
  if (table.validity != Validity::kNone && trajectory.crosses != 0) {
    table.crossing = Intercept{.x_m = trajectory.line_x_m,
                               .y_m = trajectory.crossing_y_m,
                               .in_s = trajectory.crossing_in_s,
                               .speed_m_s = trajectory.crossing_speed_m_s,
                               .bounces = trajectory.crossing_bounces,
                               .sigma_y_m = trajectory.crossing_sigma_y_m,
                               .sigma_t_s = trajectory.crossing_sigma_t_s};
  }
}

void take(const game_state_t& game, ViewTable& table) {
  table.phase = phase_words(game.phase);
  table.goals_for = game.goals_for;
  table.goals_against = game.goals_against;
  table.shots = game.shots;
  table.saves = game.saves;
}

void take(const arm_state_t& arm, ViewTable& table) {
  table.geometry.robot_line_x_m = arm.line_x_m;
  table.mallet_y_m = arm.position_m;
}

void take(const arm_command_t& command, ViewTable& table) {
  if (command.mode == arm_command_t::MODE_FOLLOW) {
    table.target_y_m = command.target_m;
  } else {
    table.target_y_m.reset();
  }
}

void take(const ground_truth_t& truth, ViewTable& table) {
  table.truth.reset();
  if (truth.in_play != 0) table.truth = TablePoint{truth.x_m, truth.y_m};
}

}  // namespace puck
