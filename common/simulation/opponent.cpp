#include "common/simulation/opponent.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr double kGuardDistance_m = 0.2;  // From the opponent's end.
constexpr double kHome_m = 0.01;          // Closer to home() than this counts as home.
constexpr double kGuardSpeed_m_s = 1.5;
constexpr double kGuardAcceleration_m_s2 = 15;
constexpr double kGuardStiffness_1_s = 8;
// The puck is struck between these shares of the table's length: one closer to the end rail is left
// to bounce off it first.
constexpr double kNearestStrike = 0.55;
constexpr double kFarthestStrike = 0.86;
constexpr double kHardestSwing_m_s = 12;
constexpr double kFollowThrough_s = 0.02;
constexpr double kPlanEvery_s = 0.02;
constexpr double kLookAhead_s = 1e-3;

constexpr std::uint64_t kOpponentStream = 1;
constexpr std::uint64_t kShotStream = 2;

}  // namespace

Opponent::Opponent(const PuckPhysics& physics, const GameParams& params, std::int64_t seed)
    : physics_(physics),
      params_(params),
      random_(seed, kOpponentStream),
      planner_(physics, params, Random(seed, kShotStream)) {
  mallet_.position = home();
}

TablePoint Opponent::home() const { return {physics_.table().length_m - kGuardDistance_m, 0}; }

bool Opponent::is_home() const {
  return !swing_ &&
         std::hypot(mallet_.position.x_m - home().x_m, mallet_.position.y_m - home().y_m) < kHome_m;
}

void Opponent::step(const std::optional<DiscState>& puck, double dt_s, Conduct conduct) {
  if (swing_) {
    follow_swing(dt_s);
    return;
  }
  guard(conduct == Conduct::kServes ? std::nullopt : puck, dt_s);

  const bool is_here = puck && puck->position.x_m > physics_.table().length_m / 2;
  if (is_here && !puck_is_here_) {
    strike_in_s_ = random_.uniform(params_.wait_min_s, params_.wait_max_s);
    planner_.draw();
  }
  puck_is_here_ = is_here;
  strike_in_s_ -= dt_s;
  if (!is_here || strike_in_s_ > 0 || conduct != Conduct::kPlays) return;
  swing_ = plan(*puck);
  if (!swing_) {
    strike_in_s_ = kPlanEvery_s;
    planner_.draw();
  }
}

void Opponent::guard(const std::optional<DiscState>& puck, double dt_s) {
  const double goal_half_m = physics_.table().goal_width_m / 2;
  TablePoint place = home();
  if (puck) place.y_m = std::clamp(0.6 * puck->position.y_m, -goal_half_m, goal_half_m);
  const double dx_m = place.x_m - mallet_.position.x_m;
  const double dy_m = place.y_m - mallet_.position.y_m;
  const double distance_m = std::hypot(dx_m, dy_m);
  const double gain_1_s =
      std::min(kGuardStiffness_1_s, kGuardSpeed_m_s / std::max(distance_m, 1e-9));

  const double change_x = gain_1_s * dx_m - mallet_.velocity.x_m_s;
  const double change_y = gain_1_s * dy_m - mallet_.velocity.y_m_s;
  const double most_m_s = kGuardAcceleration_m_s2 * dt_s;
  const double share = std::min(1.0, most_m_s / std::max(std::hypot(change_x, change_y), 1e-12));
  mallet_.velocity.x_m_s += share * change_x;
  mallet_.velocity.y_m_s += share * change_y;
  mallet_.position.x_m += mallet_.velocity.x_m_s * dt_s;
  mallet_.position.y_m += mallet_.velocity.y_m_s * dt_s;
  keep_on_table();
}

void Opponent::follow_swing(double dt_s) {
  swing_->elapsed_s += dt_s;
  if (swing_->elapsed_s > swing_->duration_s + kFollowThrough_s) {
    swing_.reset();
    puck_is_here_ = false;
    return;
  }
  mallet_ = swing_->at(swing_->elapsed_s);
  keep_on_table();
}

DiscState Opponent::Swing::at(double t_s) const {
  if (t_s >= duration_s) {
    const double late_s = t_s - duration_s;
    return {{to.position.x_m + late_s * to.velocity.x_m_s,
             to.position.y_m + late_s * to.velocity.y_m_s},
            to.velocity};
  }
  const double s = t_s / duration_s;
  const auto place = [&](double p0, double v0, double p1, double v1) {
    return p0 * (1 + 2 * s) * (1 - s) * (1 - s) + v0 * duration_s * s * (1 - s) * (1 - s) +
           p1 * s * s * (3 - 2 * s) + v1 * duration_s * s * s * (s - 1);
  };
  const auto speed = [&](double p0, double v0, double p1, double v1) {
    return 6 * s * (1 - s) * (p1 - p0) / duration_s + v0 * (1 - s) * (1 - 3 * s) +
           v1 * s * (3 * s - 2);
  };
  return {{place(from.position.x_m, from.velocity.x_m_s, to.position.x_m, to.velocity.x_m_s),
           place(from.position.y_m, from.velocity.y_m_s, to.position.y_m, to.velocity.y_m_s)},
          {speed(from.position.x_m, from.velocity.x_m_s, to.position.x_m, to.velocity.x_m_s),
           speed(from.position.y_m, from.velocity.y_m_s, to.position.y_m, to.velocity.y_m_s)}};
}

std::optional<Opponent::Swing> Opponent::plan(const DiscState& puck) const {
  constexpr double kShortest_s = 0.12;
  constexpr double kLongest_s = 0.4;
  constexpr double kStep_s = 0.04;
  DiscState ahead = puck;
  double t_s = 0;
  for (double duration_s = kShortest_s; duration_s <= kLongest_s; duration_s += kStep_s) {
    for (; t_s < duration_s; t_s += kLookAhead_s) physics_.glide(ahead, kLookAhead_s);
    const double share = ahead.position.x_m / physics_.table().length_m;
    if (share < kNearestStrike) return std::nullopt;
    if (share > kFarthestStrike) continue;
    const auto strike = planner_.strike(ahead);
    if (!strike) continue;
    if (std::hypot(strike->at_contact.x_m_s, strike->at_contact.y_m_s) > kHardestSwing_m_s) {
      continue;
    }
    const Swing swing{mallet_, {strike->contact, strike->at_contact}, t_s, 0};
    if (is_clear(swing, puck)) return swing;
  }
  return std::nullopt;
}

// Whether the mallet stays on its half of the table and touches the puck only at the swing's end.
bool Opponent::is_clear(const Swing& swing, const DiscState& puck) const {
  constexpr double kAlmost_s = 0.01;
  const TableGeometry& table = physics_.table();
  const double reach_m = table.puck_radius_m + table.mallet_radius_m;
  DiscState ahead = puck;
  for (double t_s = 0; t_s < swing.duration_s; t_s += kLookAhead_s) {
    const TablePoint mallet = swing.at(t_s).position;
    if (mallet.x_m < table.length_m / 2 || mallet.x_m > table.length_m - table.mallet_radius_m ||
        std::abs(mallet.y_m) > table.width_m / 2 - table.mallet_radius_m) {
      return false;
    }
    if (t_s < swing.duration_s - kAlmost_s &&
        std::hypot(ahead.position.x_m - mallet.x_m, ahead.position.y_m - mallet.y_m) < reach_m) {
      return false;
    }
    physics_.glide(ahead, kLookAhead_s);
  }
  return true;
}

void Opponent::keep_on_table() {
  const TableGeometry& table = physics_.table();
  const double radius_m = table.mallet_radius_m;
  mallet_.position.x_m =
      std::clamp(mallet_.position.x_m, table.length_m / 2 + radius_m, table.length_m - radius_m);
  const double half_m = table.width_m / 2 - radius_m;
  mallet_.position.y_m = std::clamp(mallet_.position.y_m, -half_m, half_m);
}

}  // namespace puck
