#include "common/simulation/free_hand.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr double kHeight_m = 0.1;  // Above the table.
constexpr double kFastest_m_s = 2.5;
constexpr double kAcceleration_m_s2 = 25;
constexpr double kStiffness_1_s = 12;
constexpr double kArrived_m = 0.03;
constexpr double kAway_m = 0.05;

double length_of(Vector3 v) { return std::sqrt(dot(v, v)); }

}  // namespace

FreeHand::FreeHand(const TableGeometry& table, const GameParams& params, Vector3 eye, Random random)
    : table_(table), params_(params), eye_(eye), random_(random) {}

void FreeHand::step(const std::optional<DiscState>& puck, double dt_s) {
  const bool is_here = puck && puck->position.x_m > table_.length_m / 2;
  const Vector3 home{table_.length_m + 0.4, -0.3, 0.3};
  if (is_here && !puck_is_here_ && !place_ && random_.uniform() < params_.reach_probability) {
    hide_s_ = random_.uniform(params_.reach_min_s, params_.reach_max_s);
    place_ = home;
    velocity_m_s_ = {};
  }
  puck_is_here_ = is_here;
  if (!place_) return;
  if (!is_here) hide_s_ = 0;
  if (hide_s_ <= 0) {
    move_towards(home, {}, dt_s);
    if (length_of(*place_ - home) < kAway_m) place_.reset();
    return;
  }
  const Vector3 target = hiding_place(puck->position);
  const Vector3 puck_m_s{puck->velocity.x_m_s, puck->velocity.y_m_s, 0};
  move_towards(target, (1 - kHeight_m / eye_.z) * puck_m_s, dt_s);
  if (length_of(*place_ - target) < kArrived_m) hide_s_ -= dt_s;
}

Vector3 FreeHand::hiding_place(TablePoint puck) const {
  const Vector3 on_table{puck.x_m, puck.y_m, 0};
  return on_table + (kHeight_m / eye_.z) * (eye_ - on_table);
}

void FreeHand::move_towards(Vector3 target, Vector3 target_m_s, double dt_s) {
  const Vector3 way = target - *place_;
  const double gain_1_s = std::min(kStiffness_1_s, kFastest_m_s / std::max(length_of(way), 1e-9));
  const Vector3 change = target_m_s + gain_1_s * way - velocity_m_s_;
  const double share =
      std::min(1.0, kAcceleration_m_s2 * dt_s / std::max(length_of(change), 1e-12));
  velocity_m_s_ = velocity_m_s_ + share * change;
  *place_ = *place_ + dt_s * velocity_m_s_;
}

}  // namespace puck
