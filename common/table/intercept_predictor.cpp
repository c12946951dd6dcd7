#include "common/table/intercept_predictor.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

// Uncertainty of the crossing of x = constant: to first order the place moves along the path.
Intercept crossing_of(const PuckTrack& at_line, double in_s, int bounces) {
  const auto& [position, velocity] = at_line.state;
  const Matrix4& p = at_line.covariance;
  const double slope = velocity.y_m_s / velocity.x_m_s;
  const double variance_y = p(1, 1) - 2 * slope * p(0, 1) + slope * slope * p(0, 0);
  return {position.x_m,
          position.y_m,
          in_s,
          std::hypot(velocity.x_m_s, velocity.y_m_s),
          bounces,
          std::sqrt(std::max(0.0, variance_y)),
          std::sqrt(std::max(0.0, p(0, 0))) / std::abs(velocity.x_m_s)};
}

}  // namespace

InterceptPredictor::InterceptPredictor(const PuckMotion& motion, const InterceptParams& params)
    : motion_(motion), params_(params), line_x_m_(motion.table().contact_line_x_m()) {
  if (!(params_.horizon_s > 0 && params_.horizon_s <= 60)) {
    throw std::invalid_argument("intercept.horizon_s must be above 0 and at most 60, got " +
                                std::to_string(params_.horizon_s));
  }
  if (!(params_.min_approach_m_s > 0)) {
    throw std::invalid_argument("intercept.min_approach_m_s must be positive, got " +
                                std::to_string(params_.min_approach_m_s));
  }
  if (!(params_.opponent_after_s >= 0 && params_.opponent_after_s <= 60)) {
    throw std::invalid_argument("intercept.opponent_after_s must be between 0 and 60, got " +
                                std::to_string(params_.opponent_after_s));
  }
  if (params_.max_bounces < 0 || params_.max_bounces > 64) {
    throw std::invalid_argument("intercept.max_bounces must be between 0 and 64, got " +
                                std::to_string(params_.max_bounces));
  }
}

std::optional<Intercept> InterceptPredictor::predict(const PuckTrack& track) const {
  const PuckState& now = track.state;
  if (now.position.x_m <= line_x_m_ || !(now.velocity.x_m_s < 0)) return std::nullopt;
  if (is_in_opponents_half(track) &&
      motion_.time_to_x(now, motion_.table().length_m / 2) > params_.opponent_after_s) {
    return std::nullopt;
  }
  PuckTrack at = track;
  double elapsed_s = 0;
  for (int bounces = 0; bounces <= params_.max_bounces; ++bounces) {
    const double left_s = params_.horizon_s - elapsed_s;
    const PuckMotion::Leg leg = motion_.next_leg(at, left_s);
    const double to_line_s = motion_.time_to_x(at.state, line_x_m_);
    if (to_line_s <= leg.duration_s) {
      const PuckTrack at_line = motion_.glide(at, to_line_s);
      if (-at_line.state.velocity.x_m_s < params_.min_approach_m_s) return std::nullopt;
      return crossing_of(at_line, elapsed_s + to_line_s, bounces);
    }
    if (leg.end != PuckMotion::LegEnd::kBounce) return std::nullopt;
    at = leg.track;
    elapsed_s += leg.duration_s;
  }
  return std::nullopt;
}

void InterceptPredictor::predict_path(const PuckTrack& track,
                                      const std::optional<TablePoint>& robot_mallet,
                                      double horizon_s, double step_s,
                                      std::vector<PathPoint>& path) const {
  path.clear();
  const int steps = static_cast<int>(std::floor(horizon_s / step_s));
  const double touch_m = motion_.table().puck_radius_m + motion_.table().mallet_radius_m;
  PuckTrack at = track;
  double in_opponents_half_s = 0;
  for (int i = 0; i <= steps; ++i) {
    const TablePoint& place = at.state.position;
    path.push_back({i * step_s, place});
    if (robot_mallet &&
        std::hypot(place.x_m - robot_mallet->x_m, place.y_m - robot_mallet->y_m) <= touch_m) {
      return;
    }
    if (is_in_opponents_half(at)) in_opponents_half_s += step_s;
    if (in_opponents_half_s > params_.opponent_after_s) return;
    const PuckMotion::Advanced next = motion_.advance(at, step_s);
    if (next.in_goal) return;
    at = next.track;
  }
}

}  // namespace puck
