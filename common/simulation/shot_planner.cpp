#include "common/simulation/shot_planner.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace puck {

ShotPlanner::ShotPlanner(const PuckPhysics& physics, const GameParams& params, Random random)
    : physics_(physics), params_(params), random_(random) {
  draw();
}

void ShotPlanner::draw() {
  const double free_m =
      std::max(0.0, physics_.table().goal_width_m / 2 - physics_.table().puck_radius_m);
  aim_y_m_ = random_.uniform(-free_m, free_m);
  speed_m_s_ = random_.uniform(params_.shot_speed_min_m_s, params_.shot_speed_max_m_s);
  error_rad_ = random_.normal() * params_.aim_error_deg * std::numbers::pi / 180;
  const double side = random_.uniform();
  rail_ = side < params_.bank_share / 2 ? -1 : side < params_.bank_share ? 1 : 0;
}

TableVelocity ShotPlanner::wanted_velocity(TablePoint from) const {
  double slope = (aim_y_m_ - from.y_m) / from.x_m;
  if (rail_ != 0) {
    // A bounce keeps less of the speed across the rail than along it, so the path bends there.
    const double rail_y_m = rail_ * (physics_.table().width_m / 2 - physics_.table().puck_radius_m);
    const double bend = physics_.params().rail_tangential_keep / physics_.params().rail_normal_keep;
    slope = ((rail_y_m - from.y_m) + (rail_y_m - aim_y_m_) * bend) / from.x_m;
  }
  const double angle = std::atan(slope) + error_rad_;
  return {-speed_m_s_ * std::cos(angle), speed_m_s_ * std::sin(angle)};
}

std::optional<Strike> ShotPlanner::strike(const DiscState& puck) const {
  // Without friction a hit changes the velocity only along the line between the two centres: the
  // direction of the wanted change gives the mallet's place, its size the mallet's speed.
  const TableVelocity wanted = wanted_velocity(puck.position);
  const double change_x = wanted.x_m_s - puck.velocity.x_m_s;
  const double change_y = wanted.y_m_s - puck.velocity.y_m_s;
  const double change_m_s = std::hypot(change_x, change_y);
  const double normal_x = change_x / change_m_s;
  const double normal_y = change_y / change_m_s;
  const double puck_along_m_s = puck.velocity.x_m_s * normal_x + puck.velocity.y_m_s * normal_y;
  const double mallet_m_s =
      puck_along_m_s + change_m_s / (1 + physics_.params().mallet_restitution);

  const TableGeometry& table = physics_.table();
  const double reach_m = table.puck_radius_m + table.mallet_radius_m;
  Strike strike;
  strike.puck = puck.position;
  strike.contact = {puck.position.x_m - reach_m * normal_x, puck.position.y_m - reach_m * normal_y};
  strike.at_contact = {mallet_m_s * normal_x, mallet_m_s * normal_y};
  const bool on_table = strike.contact.x_m > table.length_m / 2 &&
                        strike.contact.x_m < table.length_m - table.mallet_radius_m &&
                        std::abs(strike.contact.y_m) < table.width_m / 2 - table.mallet_radius_m;
  if (!on_table) return std::nullopt;
  return strike;
}

}  // namespace puck
