#include "common/simulation/fastest_motion.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

double speed_of(const DiscState& disc) {
  return std::hypot(disc.velocity.x_m_s, disc.velocity.y_m_s);
}

// The puck's speed, or its speed after a hit if a mallet can reach it within `ahead_s`.
double fastest_soon_m_s(const DiscState& puck, const TableGame& game,
                        const SimulationParams& params, double ahead_s) {
  double fastest = speed_of(puck);
  for (const DiscState* mallet : {&game.robot_mallet(), &game.opponent_mallet()}) {
    const double gap_m = std::hypot(puck.position.x_m - mallet->position.x_m,
                                    puck.position.y_m - mallet->position.y_m) -
                         params.table.puck_radius_m - params.table.mallet_radius_m;
    const double closing_m_s = speed_of(puck) + speed_of(*mallet);
    if (gap_m > closing_m_s * ahead_s) continue;
    const double hit_m_s = speed_of(puck) + (1 + params.physics.mallet_restitution) * closing_m_s;
    fastest = std::max(fastest, std::min(hit_m_s, params.physics.max_speed_m_s));
  }
  return fastest;
}

}  // namespace

double fastest_px_s(const TableGame& game, const SimulationParams& params, const CameraView& view,
                    double ahead_s) {
  double fastest = 0;
  const auto see = [&](Vector3 place, double speed_m_s) {
    if (const auto seen = view.project(place)) {
      fastest = std::max(fastest, speed_m_s * view.focal_px() / seen->depth_m);
    }
  };
  const auto see_disc = [&](const DiscState& disc, double speed_m_s) {
    see({disc.position.x_m, disc.position.y_m, 0}, speed_m_s);
  };
  see_disc(game.robot_mallet(), speed_of(game.robot_mallet()));
  see_disc(game.opponent_mallet(), speed_of(game.opponent_mallet()));
  if (game.puck()) see_disc(*game.puck(), fastest_soon_m_s(*game.puck(), game, params, ahead_s));
  if (const auto& second = game.second_puck()) {
    see_disc(second->state(), fastest_soon_m_s(second->state(), game, params, ahead_s));
  }
  if (const auto& hand = game.free_hand().place()) {
    const Vector3 velocity = game.free_hand().velocity_m_s();
    see(*hand, std::sqrt(dot(velocity, velocity)));
  }
  return fastest;
}

}  // namespace puck
