#include "common/simulation/second_puck.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace puck {
namespace {

// Time constant with which its speed returns to nominal after a bounce.
constexpr double kRecovery_s = 0.5;
constexpr double kSlowest_m_s = 0.01;
constexpr double kRestitution = 0.9;

TableGeometry without_goals(TableGeometry table) {
  table.goal_width_m = 0;
  return table;
}

PhysicsParams without_loss(PhysicsParams params) {
  params.damping_1_s = 0;
  params.rail_normal_keep = 1;
  params.rail_tangential_keep = 1;
  return params;
}

}  // namespace

SecondPuck::SecondPuck(const TableGeometry& table, const PhysicsParams& params, double speed_m_s,
                       Random random)
    : physics_(without_goals(table), without_loss(params)), speed_m_s_(speed_m_s) {
  // An oblique direction, so that it visits the whole table.
  const double angle = random.uniform(0.15, 0.35) * std::numbers::pi;
  state_.position = {random.uniform(0.3, 0.5) * table.length_m,
                     random.uniform(-0.3, 0.3) * table.width_m};
  state_.velocity = {speed_m_s * std::cos(angle), speed_m_s * std::sin(angle)};
}

void SecondPuck::step(const DiscState& robot, const DiscState& opponent) {
  physics_.hit(state_, robot);
  physics_.hit(state_, opponent);
  physics_.glide(state_, PuckPhysics::kStep_s);
  const double speed_m_s = std::hypot(state_.velocity.x_m_s, state_.velocity.y_m_s);
  if (speed_m_s < kSlowest_m_s) {
    state_.velocity = {-speed_m_s_ * std::numbers::sqrt2 / 2, speed_m_s_ * std::numbers::sqrt2 / 2};
    return;
  }
  const double share = PuckPhysics::kStep_s / kRecovery_s;
  const double scale = 1 + share * (speed_m_s_ / speed_m_s - 1);
  state_.velocity.x_m_s *= scale;
  state_.velocity.y_m_s *= scale;
}

bool SecondPuck::collide(DiscState& puck) {
  const double reach_m = 2 * physics_.table().puck_radius_m;
  const double dx_m = puck.position.x_m - state_.position.x_m;
  const double dy_m = puck.position.y_m - state_.position.y_m;
  const double distance_m = std::hypot(dx_m, dy_m);
  if (distance_m >= reach_m) return false;

  const double normal_x = distance_m > 0 ? dx_m / distance_m : 1;
  const double normal_y = distance_m > 0 ? dy_m / distance_m : 0;
  const double apart_m = (reach_m - distance_m) / 2;
  puck.position.x_m += apart_m * normal_x;
  puck.position.y_m += apart_m * normal_y;
  state_.position.x_m -= apart_m * normal_x;
  state_.position.y_m -= apart_m * normal_y;
  const double closing_m_s = (puck.velocity.x_m_s - state_.velocity.x_m_s) * normal_x +
                             (puck.velocity.y_m_s - state_.velocity.y_m_s) * normal_y;
  if (closing_m_s >= 0) return true;
  // Equal masses share the change of velocity.
  const double change_m_s = -(1 + kRestitution) / 2 * closing_m_s;
  puck.velocity.x_m_s += change_m_s * normal_x;
  puck.velocity.y_m_s += change_m_s * normal_y;
  state_.velocity.x_m_s -= change_m_s * normal_x;
  state_.velocity.y_m_s -= change_m_s * normal_y;
  return true;
}

}  // namespace puck
