#include "common/table/puck_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace puck {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// More than a puck of any plausible speed makes in any time that somebody predicts.
constexpr int kMaxBounces = 64;

void require(bool holds, const char* what, double got) {
  if (holds) return;
  std::ostringstream text;
  text << what << ", got " << got;
  throw std::invalid_argument(text.str());
}

void check(const TableGeometry& table) {
  require(table.puck_radius_m > 0, "table.puck_radius_m must be positive", table.puck_radius_m);
  require(table.mallet_radius_m > 0, "table.mallet_radius_m must be positive",
          table.mallet_radius_m);
  require(std::isfinite(table.length_m) && table.length_m > 4 * table.puck_radius_m,
          "table.length_m must be at least four radii of the puck", table.length_m);
  require(std::isfinite(table.width_m) && table.width_m > 4 * table.puck_radius_m,
          "table.width_m must be at least four radii of the puck", table.width_m);
  require(table.goal_width_m >= 0 && table.goal_width_m <= table.width_m,
          "table.goal_width_m must be between 0 and table.width_m", table.goal_width_m);
  require(table.robot_line_x_m >= 0 && table.robot_line_x_m <= table.length_m / 2,
          "table.robot_line_x_m must be in the robot's half", table.robot_line_x_m);
  require(table.robot_line_half_m > 0 && table.robot_line_half_m <= table.width_m / 2,
          "table.robot_line_half_m must be positive and at most half of table.width_m",
          table.robot_line_half_m);
}

void check(const PuckMotionParams& params) {
  require(params.damping_per_s >= 0 && params.damping_per_s <= 100,
          "motion.damping_per_s must be between 0 and 100", params.damping_per_s);
  require(params.rail_restitution >= 0 && params.rail_restitution <= 1,
          "motion.rail_restitution must be between 0 and 1", params.rail_restitution);
  require(params.rail_grip >= 0 && params.rail_grip <= 1,
          "motion.rail_grip must be between 0 and 1", params.rail_grip);
  require(params.velocity_noise_m_s >= 0 && params.velocity_noise_m_s <= 100,
          "motion.velocity_noise_m_s must be between 0 and 100", params.velocity_noise_m_s);
  require(params.bounce_spread >= 0 && params.bounce_spread <= 1,
          "motion.bounce_spread must be between 0 and 1", params.bounce_spread);
}

// Time in which gliding at speed `v` covers the signed `distance`. One that is already behind
// counts as reached.
double time_to_cover(double distance, double v, double damping) {
  if (v == 0) return kNever;
  const double undamped_s = std::max(0.0, distance / v);
  if (damping == 0) return undamped_s;
  const double remaining = 1 - damping * undamped_s;
  return remaining > 0 ? -std::log(remaining) / damping : kNever;
}

// The wall towards which a coordinate moves, between `low` and `high`.
double wall_ahead(double v, double low, double high) { return v < 0 ? low : high; }

}  // namespace

PuckMotion::PuckMotion(const TableGeometry& table, const PuckMotionParams& params)
    : table_(table), params_(params) {
  check(table_);
  check(params_);
}

PuckTrack PuckMotion::glide(const PuckTrack& start, double dt_s) const {
  const double c = params_.damping_per_s;
  const double kept = std::exp(-c * dt_s);
  // Distance covered per unit of initial velocity, s.
  const double reach_s = c > 0 ? -std::expm1(-c * dt_s) / c : dt_s;
  const auto& [position, velocity] = start.state;

  PuckTrack end;
  end.state.position = {position.x_m + velocity.x_m_s * reach_s,
                        position.y_m + velocity.y_m_s * reach_s};
  end.state.velocity = {velocity.x_m_s * kept, velocity.y_m_s * kept};

  const Matrix4 f{1, 0, reach_s, 0, 0, 1, 0, reach_s, 0, 0, kept, 0, 0, 0, 0, kept};
  // White noise on the acceleration.
  const double q = params_.velocity_noise_m_s * params_.velocity_noise_m_s;
  const double pp = q * dt_s * dt_s * dt_s / 3;
  const double pv = q * dt_s * dt_s / 2;
  const double vv = q * dt_s;
  const Matrix4 noise{pp, 0, pv, 0, 0, pp, 0, pv, pv, 0, vv, 0, 0, pv, 0, vv};
  end.covariance = sum(carried(f, start.covariance), noise);
  return end;
}

double PuckMotion::time_to_x(const PuckState& start, double x_m) const {
  const double distance = x_m - start.position.x_m;
  if (distance * start.velocity.x_m_s < 0) return kNever;
  return time_to_cover(distance, start.velocity.x_m_s, params_.damping_per_s);
}

PuckMotion::Leg PuckMotion::next_leg(const PuckTrack& start, double limit_s) const {
  const auto& [position, velocity] = start.state;
  const double radius = table_.puck_radius_m;
  const double side = table_.width_m / 2 - radius;
  const double wall_x = wall_ahead(velocity.x_m_s, radius, table_.length_m - radius);
  const double wall_y = wall_ahead(velocity.y_m_s, -side, side);
  const double end_rail_s =
      time_to_cover(wall_x - position.x_m, velocity.x_m_s, params_.damping_per_s);
  const double side_rail_s =
      time_to_cover(wall_y - position.y_m, velocity.y_m_s, params_.damping_per_s);

  Leg leg;
  leg.duration_s = std::min({end_rail_s, side_rail_s, limit_s});
  leg.track = glide(start, leg.duration_s);
  if (leg.duration_s == limit_s && limit_s < std::min(end_rail_s, side_rail_s)) return leg;

  PuckState& state = leg.track.state;
  const bool at_end_rail = end_rail_s <= side_rail_s;
  if (at_end_rail && std::abs(state.position.y_m) < table_.goal_width_m / 2 - radius) {
    state.velocity = {};
    leg.end = LegEnd::kGoal;
    return leg;
  }

  leg.end = LegEnd::kBounce;
  const double speed = std::hypot(state.velocity.x_m_s, state.velocity.y_m_s);
  const double back = -params_.rail_restitution;
  const double along = params_.rail_grip;
  Matrix4 reflection;
  if (at_end_rail) {
    state.position.x_m = wall_x;
    state.velocity = {back * state.velocity.x_m_s, along * state.velocity.y_m_s};
    reflection = diagonal(back, 1, back, along);
  } else {
    state.position.y_m = wall_y;
    state.velocity = {along * state.velocity.x_m_s, back * state.velocity.y_m_s};
    reflection = diagonal(1, back, along, back);
  }
  // To first order the place beyond the rail is the mirror image of the one before it, scaled
  // like the speed. What the moment of the bounce does to the place along the rail is left out: it
  // is small, and grows without bound where the puck grazes the rail.
  const double spread = params_.bounce_spread * speed;
  leg.track.covariance = sum(carried(reflection, leg.track.covariance),
                             diagonal(0, 0, spread * spread, spread * spread));
  return leg;
}

PuckMotion::Advanced PuckMotion::advance(const PuckTrack& start, double dt_s) const {
  Advanced result{start};
  double left_s = dt_s;
  while (left_s > 0 && result.bounces < kMaxBounces) {
    const Leg leg = next_leg(result.track, left_s);
    result.track = leg.track;
    left_s -= leg.duration_s;
    if (leg.end == LegEnd::kTimeUp) break;
    if (leg.end == LegEnd::kGoal) {
      result.in_goal = true;
      break;
    }
    ++result.bounces;
  }
  return result;
}

}  // namespace puck
