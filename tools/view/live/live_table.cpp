#include "tools/view/live/live_table.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <string>

namespace puck {
namespace {

constexpr std::int64_t kStaleAfter_us = 500'000;

std::string phase_name(std::int8_t phase) {
  constexpr std::array kNames{"waiting", "rally",      "shot at robot",
                              "goal",    "puck stuck", "puck out of view"};
  const auto index = static_cast<std::size_t>(phase);
  return phase >= 0 && index < kNames.size() ? kNames.at(index) : "";
}

void show(const puck_trajectory_t& trajectory, ViewTable& table) {
  table.validity = static_cast<ViewTable::Validity>(trajectory.validity);
  if (table.validity == ViewTable::Validity::kNone) return;
  table.puck.state = {{trajectory.x_m, trajectory.y_m}, {trajectory.vx_m_s, trajectory.vy_m_s}};
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 4; ++column) {
      table.puck.covariance(row, column) = trajectory.covariance[4 * row + column];
    }
  }
  for (std::size_t i = 0; i < trajectory.path_t_s.size(); ++i) {
    table.path.push_back(
        {trajectory.path_t_s[i], {trajectory.path_x_m[i], trajectory.path_y_m[i]}});
  }
  if (!trajectory.crosses) return;
  table.crossing = Intercept{.x_m = trajectory.line_x_m,
                             .y_m = trajectory.crossing_y_m,
                             .in_s = trajectory.crossing_in_s,
                             .speed_m_s = trajectory.crossing_speed_m_s,
                             .bounces = trajectory.crossing_bounces,
                             .sigma_y_m = trajectory.crossing_sigma_y_m,
                             .sigma_t_s = trajectory.crossing_sigma_t_s};
}

void show(const arm_state_t& arm, ViewTable& table) {
  table.geometry.robot_line_x_m = arm.line_x_m;
  table.geometry.robot_line_half_m = std::abs(arm.line_max_m - arm.line_min_m) / 2;
  table.mallet_y_m = arm.position_m;
  if (arm.state == arm_state_t::STATE_MOVING) table.target_y_m = arm.target_m;
}

void show(const game_state_t& game, ViewTable& table) {
  table.phase = phase_name(game.phase);
  table.goals_for = game.goals_for;
  table.goals_against = game.goals_against;
  table.shots = game.shots;
  table.saves = game.saves;
}

void show(const ground_truth_t& truth, ViewTable& table) {
  if (truth.in_play) table.truth = TablePoint{truth.x_m, truth.y_m};
}

}  // namespace

std::optional<ViewTable> LiveTable::table(std::int64_t now_us) const {
  if (!trajectory_.message && !arm_.message && !game_.message && !truth_.message) {
    return std::nullopt;
  }
  ViewTable table;
  const auto show_fresh = [&](const auto& newest) {
    if (newest.message && now_us - newest.time_us <= kStaleAfter_us) show(*newest.message, table);
  };
  show_fresh(trajectory_);
  show_fresh(arm_);
  show_fresh(game_);
  show_fresh(truth_);
  return table;
}

}  // namespace puck
