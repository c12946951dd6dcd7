#include "common/simulation/simulation_params.h"

#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "common/simulation/puck_physics.h"
#include "common/simulation/visit_parameters.h"

namespace puck {
namespace {

/// A reader for `visit_parameters` that only checks the ranges.
class RangeChecker {
 public:
  void read(std::string_view, bool) {}

  template <typename Number>
  void read(std::string_view key, Number value, Number lowest, Number highest) {
    if (value >= lowest && value <= highest) return;
    std::ostringstream message;
    message << key << " must be between " << lowest << " and " << highest << ", got " << value;
    throw std::invalid_argument(message.str());
  }
};

void require(bool holds, const std::string& message) {
  if (!holds) throw std::invalid_argument(message);
}

}  // namespace

void check(const SimulationParams& params) {
  RangeChecker checker;
  SimulationParams copy = params;
  visit_parameters(checker, copy);

  constexpr std::int64_t kStep_us = PuckPhysics::kStep_us;
  require(params.slice_us % kStep_us == 0, "world.slice_us must be a multiple of " +
                                               std::to_string(kStep_us) + ", got " +
                                               std::to_string(params.slice_us));
  require(params.table.goal_width_m < params.table.width_m,
          "table.goal_width_m must be less than table.width_m");
  require(params.table.robot_line_half_m + params.table.mallet_radius_m <= params.table.width_m / 2,
          "table.robot_line_half_m must leave room for the mallet between the side rails");
  const SceneParams& scene = params.scene;
  if (scene.puck_print_luminance > 0) {
    require(scene.puck_print_radius_m + scene.puck_print_width_m / 2 < params.table.puck_radius_m,
            "scene.puck_print_radius_m and half of scene.puck_print_width_m must be less than "
            "table.puck_radius_m together");
    require(scene.puck_print_width_m < 2 * scene.puck_print_radius_m,
            "scene.puck_print_width_m must be less than twice scene.puck_print_radius_m");
  }
  require(params.game.shot_speed_min_m_s <= params.game.shot_speed_max_m_s,
          "game.shot_speed_min_m_s must not be more than game.shot_speed_max_m_s");
  require(params.game.wait_min_s <= params.game.wait_max_s,
          "game.wait_min_s must not be more than game.wait_max_s");
  require(params.game.rest_min_s <= params.game.rest_max_s,
          "game.rest_min_s must not be more than game.rest_max_s");
  require(params.game.reach_min_s <= params.game.reach_max_s,
          "game.reach_min_s must not be more than game.reach_max_s");
}

}  // namespace puck
