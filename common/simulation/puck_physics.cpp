#include "common/simulation/puck_physics.h"

#include <algorithm>
#include <cmath>

namespace puck {

PuckPhysics::PuckPhysics(const TableGeometry& table, const PhysicsParams& params)
    : table_(table), params_(params) {}

void PuckPhysics::glide(DiscState& puck, double dt_s) const {
  const double keep = 1 / (1 + params_.damping_1_s * dt_s);
  puck.velocity.x_m_s *= keep;
  puck.velocity.y_m_s *= keep;
  puck.position.x_m += puck.velocity.x_m_s * dt_s;
  puck.position.y_m += puck.velocity.y_m_s * dt_s;

  const double side_m = table_.width_m / 2 - table_.puck_radius_m;
  const double beyond_m = std::abs(puck.position.y_m) - side_m;
  if (beyond_m > 0) {
    puck.position.y_m =
        std::copysign(side_m - params_.rail_normal_keep * beyond_m, puck.position.y_m);
    if (puck.velocity.y_m_s * puck.position.y_m > 0) {
      puck.velocity.y_m_s *= -params_.rail_normal_keep;
      puck.velocity.x_m_s *= params_.rail_tangential_keep;
    }
  }

  // Both ends are treated alike, each as a distance from its rail and a speed away from it.
  double distance_m = puck.position.x_m;
  double away_m_s = puck.velocity.x_m_s;
  bounce_off_end(distance_m, away_m_s, puck);
  puck.position.x_m = distance_m;
  puck.velocity.x_m_s = away_m_s;

  distance_m = table_.length_m - puck.position.x_m;
  away_m_s = -puck.velocity.x_m_s;
  bounce_off_end(distance_m, away_m_s, puck);
  puck.position.x_m = table_.length_m - distance_m;
  puck.velocity.x_m_s = -away_m_s;
}

void PuckPhysics::bounce_off_end(double& distance_m, double& away_m_s, DiscState& puck) const {
  const double radius_m = table_.puck_radius_m;
  if (distance_m >= radius_m) return;

  double& y_m = puck.position.y_m;
  double& along_m_s = puck.velocity.y_m_s;
  const double goal_half_m = table_.goal_width_m / 2;
  if (std::abs(y_m) >= goal_half_m) {
    distance_m = radius_m + params_.rail_normal_keep * (radius_m - distance_m);
    if (away_m_s < 0) {
      away_m_s *= -params_.rail_normal_keep;
      along_m_s *= params_.rail_tangential_keep;
    }
    return;
  }
  if (distance_m < 0) {
    // Between the walls of the goal's opening.
    const double free_m = std::max(0.0, goal_half_m - radius_m);
    if (std::abs(y_m) > free_m) {
      y_m = std::copysign(free_m, y_m);
      if (along_m_s * y_m > 0) along_m_s *= -params_.rail_normal_keep;
    }
    return;
  }
  // In the goal mouth only the goal posts, which are points, can be hit.
  const double post_y_m = std::copysign(goal_half_m, y_m);
  const double offset_y_m = y_m - post_y_m;
  const double to_post_m = std::hypot(distance_m, offset_y_m);
  if (to_post_m >= radius_m || to_post_m == 0) return;
  const double normal_x = distance_m / to_post_m;
  const double normal_y = offset_y_m / to_post_m;
  distance_m = radius_m * normal_x;
  y_m = post_y_m + radius_m * normal_y;
  const double normal_m_s = away_m_s * normal_x + along_m_s * normal_y;
  if (normal_m_s >= 0) return;
  const double tangential_m_s = along_m_s * normal_x - away_m_s * normal_y;
  const double normal_after_m_s = -params_.rail_normal_keep * normal_m_s;
  const double tangential_after_m_s = params_.rail_tangential_keep * tangential_m_s;
  away_m_s = normal_after_m_s * normal_x - tangential_after_m_s * normal_y;
  along_m_s = normal_after_m_s * normal_y + tangential_after_m_s * normal_x;
}

bool PuckPhysics::hit(DiscState& puck, const DiscState& mallet) const {
  const double reach_m = table_.puck_radius_m + table_.mallet_radius_m;
  const double dx_m = puck.position.x_m - mallet.position.x_m;
  const double dy_m = puck.position.y_m - mallet.position.y_m;
  const double distance_m = std::hypot(dx_m, dy_m);
  if (distance_m >= reach_m) return false;

  const double normal_x = distance_m > 0 ? dx_m / distance_m : 1;
  const double normal_y = distance_m > 0 ? dy_m / distance_m : 0;
  puck.position = {mallet.position.x_m + reach_m * normal_x,
                   mallet.position.y_m + reach_m * normal_y};
  const double closing_m_s = (puck.velocity.x_m_s - mallet.velocity.x_m_s) * normal_x +
                             (puck.velocity.y_m_s - mallet.velocity.y_m_s) * normal_y;
  if (closing_m_s < 0) {
    const double change_m_s = -(1 + params_.mallet_restitution) * closing_m_s;
    puck.velocity.x_m_s += change_m_s * normal_x;
    puck.velocity.y_m_s += change_m_s * normal_y;
    const double speed_m_s = std::hypot(puck.velocity.x_m_s, puck.velocity.y_m_s);
    if (speed_m_s > params_.max_speed_m_s) {
      puck.velocity.x_m_s *= params_.max_speed_m_s / speed_m_s;
      puck.velocity.y_m_s *= params_.max_speed_m_s / speed_m_s;
    }
  }
  return true;
}

GoalEntered PuckPhysics::goal_of(const DiscState& puck) const {
  if (puck.position.x_m < -table_.puck_radius_m) return GoalEntered::kRobots;
  if (puck.position.x_m > table_.length_m + table_.puck_radius_m) return GoalEntered::kOpponents;
  return GoalEntered::kNone;
}

bool PuckPhysics::would_enter_robots_goal(DiscState puck) const {
  // A slower puck is not a shot any more; the limit also bounds the work.
  constexpr double kSlowest_m_s = 0.1;
  while (puck.velocity.x_m_s < -kSlowest_m_s) {
    glide(puck, kStep_s);
    if (goal_of(puck) == GoalEntered::kRobots) return true;
  }
  return false;
}

}  // namespace puck
