#include "common/table/puck_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "common/table/require.h"

namespace puck {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
// More than a puck of any plausible speed makes within any prediction.
constexpr int kMaxBounces = 64;

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

// Time in which a puck with damping and initial speed `v` covers the signed `distance`; 0 for a
// distance already passed.
double time_to_cover(double distance, double v, double damping) {
  if (v == 0) return kNever;
  const double undamped_s = std::max(0.0, distance / v);
  if (damping == 0) return undamped_s;
  const double remaining = 1 - damping * undamped_s;
  return remaining > 0 ? -std::log(remaining) / damping : kNever;
}

// The wall that a coordinate approaches, `low` or `high`.
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

  Matrix4 f = diagonal(1, 1, kept, kept);
  f.topRightCorner<2, 2>().diagonal().setConstant(reach_s);
  // White noise on the acceleration.
  const double q = params_.velocity_noise_m_s * params_.velocity_noise_m_s;
  const double pp = q * dt_s * dt_s * dt_s / 3;
  const double pv = q * dt_s * dt_s / 2;
  const double vv = q * dt_s;
  Matrix4 noise = diagonal(pp, pp, vv, vv);
  noise.topRightCorner<2, 2>().diagonal().setConstant(pv);
  noise.bottomLeftCorner<2, 2>().diagonal().setConstant(pv);
  end.covariance = carried(f, start.covariance) + noise;
  return end;
}

double PuckMotion::time_to_x(const PuckState& start, double x_m) const {
  const double distance = x_m - start.position.x_m;
  if (distance * start.velocity.x_m_s < 0) return kNever;
  return time_to_cover(distance, start.velocity.x_m_s, params_.damping_per_s);
}

std::optional<PuckMotion::Contact> PuckMotion::next_post(const PuckState& start) const {
  const auto& [position, velocity] = start;
  const double radius = table_.puck_radius_m;
  const double speed_squared = velocity.x_m_s * velocity.x_m_s + velocity.y_m_s * velocity.y_m_s;
  std::optional<Contact> first;
  for (const double rail_x : {0.0, table_.length_m}) {
    for (const double post_y : {-table_.goal_width_m / 2, table_.goal_width_m / 2}) {
      // Solve |offset + s velocity| = radius.
      const double x = position.x_m - rail_x;
      const double y = position.y_m - post_y;
      const double approach = x * velocity.x_m_s + y * velocity.y_m_s;
      const double gap = x * x + y * y - radius * radius;
      const double root = approach * approach - speed_squared * gap;
      if (!(approach < 0) || root < 0) continue;
      const double s = std::max(0.0, (-approach - std::sqrt(root)) / speed_squared);
      const double hit_x = x + s * velocity.x_m_s;
      const double hit_y = y + s * velocity.y_m_s;
      // Beside and behind the mouth there are walls.
      const bool is_before_rail = rail_x == 0 ? hit_x >= 0 : hit_x <= 0;
      const bool is_in_mouth = std::abs(hit_y + post_y) < table_.goal_width_m / 2;
      const double after_s = time_to_cover(s, 1, params_.damping_per_s);
      if (!is_before_rail || !is_in_mouth || (first && after_s >= first->after_s)) continue;
      const double distance = std::hypot(hit_x, hit_y);
      if (distance > 0) first = Contact{after_s, hit_x / distance, hit_y / distance};
    }
  }
  return first;
}

PuckTrack PuckMotion::bounced(const PuckTrack& at, double normal_x, double normal_y,
                              double curvature_1_m) const {
  const double back = -params_.rail_restitution;
  const double along = params_.rail_grip;
  const auto& [position, velocity] = at.state;
  const Eigen::Vector2d normal(normal_x, normal_y);
  const Eigen::Vector2d tangent(-normal_y, normal_x);
  const Matrix2 across = normal * normal.transpose();
  const Matrix2 beside = tangent * tangent.transpose();
  // The restitution scales the reversed velocity along the normal n, the grip the one along the
  // tangent.
  const Matrix2 turn = back * across + along * beside;
  const Eigen::Vector2d turned = turn * Eigen::Vector2d(velocity.x_m_s, velocity.y_m_s);
  PuckTrack after;
  after.state.position = position;
  after.state.velocity = {turned.x(), turned.y()};
  // To first order the position beyond the contact is the mirror image of the one before it, scaled
  // like the speed. The effect of the bounce's time on the position along the rail is left out: it
  // is small, and grows without bound where the puck grazes the rail.
  Matrix4 reflection = Matrix4::Zero();
  reflection.topLeftCorner<2, 2>() = back * across + beside;
  reflection.bottomRightCorner<2, 2>() = turn;
  const double speed = std::hypot(velocity.x_m_s, velocity.y_m_s);
  const double spread = params_.bounce_spread * speed;
  // At a post the normal depends on where the puck meets it.
  const double along_variance = tangent.dot(at.covariance.topLeftCorner<2, 2>() * tangent);
  const double turn_m_s = (1 - back) * speed * curvature_1_m;
  const double variance = spread * spread + turn_m_s * turn_m_s * std::max(0.0, along_variance);
  after.covariance = carried(reflection, at.covariance) + diagonal(0, 0, variance, variance);
  return after;
}

PuckMotion::Leg PuckMotion::next_leg(const PuckTrack& start, double limit_s) const {
  const auto& [position, velocity] = start.state;
  const double damping = params_.damping_per_s;
  const double radius = table_.puck_radius_m;
  const double side = table_.width_m / 2 - radius;
  const double wall_x = wall_ahead(velocity.x_m_s, radius, table_.length_m - radius);
  const double wall_y = wall_ahead(velocity.y_m_s, -side, side);
  double end_rail_s = time_to_cover(wall_x - position.x_m, velocity.x_m_s, damping);
  const double side_rail_s = time_to_cover(wall_y - position.y_m, velocity.y_m_s, damping);

  // In a goal's mouth only the two posts, which are points, can be hit.
  double goal_s = kNever;
  std::optional<Contact> post;
  const bool meets_end = end_rail_s <= side_rail_s && end_rail_s <= limit_s;
  const auto is_in_mouth = [&](double y_m) { return std::abs(y_m) < table_.goal_width_m / 2; };
  if (meets_end && is_in_mouth(glide(start, end_rail_s).state.position.y_m)) {
    const double inside_x = wall_ahead(velocity.x_m_s, -radius, table_.length_m + radius);
    goal_s = time_to_cover(inside_x - position.x_m, velocity.x_m_s, damping);
    end_rail_s = kNever;
  }
  const double to_end = std::min(position.x_m, table_.length_m - position.x_m);
  if (goal_s < kNever || (to_end < radius && is_in_mouth(position.y_m)))
    post = next_post(start.state);
  const double post_s = post ? post->after_s : kNever;

  Leg leg;
  leg.duration_s = std::min({end_rail_s, side_rail_s, goal_s, post_s, limit_s});
  leg.track = glide(start, leg.duration_s);
  if (leg.duration_s == limit_s && limit_s < std::min({end_rail_s, side_rail_s, goal_s, post_s})) {
    return leg;
  }
  leg.end = LegEnd::kBounce;
  if (leg.duration_s == post_s) {
    leg.track = bounced(leg.track, post->normal_x, post->normal_y, 1 / radius);
  } else if (leg.duration_s == goal_s) {
    leg.track.state.velocity = {};
    leg.end = LegEnd::kGoal;
  } else if (end_rail_s <= side_rail_s) {
    leg.track.state.position.x_m = wall_x;
    leg.track = bounced(leg.track, 1, 0, 0);
  } else {
    leg.track.state.position.y_m = wall_y;
    leg.track = bounced(leg.track, 0, 1, 0);
  }
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
