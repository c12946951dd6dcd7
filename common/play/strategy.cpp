#include "common/play/strategy.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace puck {
namespace {

constexpr double kGoesAwayMS = 0.3;  // slower: no direction

}  // namespace

Strategy::Strategy(const StrategyParams& params, const TableGeometry& table)
    : params_(params), table_(table) {
  if (!(params_.crossing_prior_m > 0 && params_.crossing_prior_m <= 10)) {
    throw std::invalid_argument("strategy.crossing_prior_m must be above 0 and at most 10, got " +
                                std::to_string(params_.crossing_prior_m));
  }
  if (!(params_.shadow_gain >= 0 && params_.shadow_gain <= 1)) {
    throw std::invalid_argument("strategy.shadow_gain must be between 0 and 1, got " +
                                std::to_string(params_.shadow_gain));
  }
}

Wish Strategy::decide(const PuckTrack& track, const std::optional<Intercept>& crossing) const {
  // Beyond the posts a puck misses the goal, and the mallet would have a long way back.
  const double post_m = table_.goal_width_m / 2;
  if (crossing) {
    const double prior = params_.crossing_prior_m * params_.crossing_prior_m;
    const double weight = prior / (prior + crossing->sigma_y_m * crossing->sigma_y_m);
    return {std::clamp(weight * crossing->y_m, -post_m, post_m), crossing->in_s};
  }
  const double vx_m_s = track.state.velocity.x_m_s;
  const bool is_near = track.state.position.x_m < table_.length_m / 2;
  if (vx_m_s > kGoesAwayMS || !is_near) return {};
  return {std::clamp(params_.shadow_gain * track.state.position.y_m, -post_m, post_m), 0};
}

}  // namespace puck
