#include "common/play/strategy.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace puck {

Strategy::Strategy(const StrategyParams& params, const TableGeometry& table)
    : params_(params), table_(table) {
  if (!(params_.max_crossing_sigma_m > 0)) {
    throw std::invalid_argument("strategy.max_crossing_sigma_m must be positive, got " +
                                std::to_string(params_.max_crossing_sigma_m));
  }
  if (!(params_.shadow_gain >= 0 && params_.shadow_gain <= 1)) {
    throw std::invalid_argument("strategy.shadow_gain must be between 0 and 1, got " +
                                std::to_string(params_.shadow_gain));
  }
}

Wish Strategy::decide(const PuckTrack& track, const std::optional<Intercept>& crossing) const {
  if (crossing && crossing->sigma_y_m <= params_.max_crossing_sigma_m) {
    return {crossing->y_m, crossing->in_s};
  }
  const bool comes = track.state.velocity.x_m_s < 0;
  const bool is_near = track.state.position.x_m < table_.length_m / 2;
  if (!comes && !is_near) return {};
  const double post_m = table_.goal_width_m / 2;
  return {std::clamp(params_.shadow_gain * track.state.position.y_m, -post_m, post_m), 0};
}

}  // namespace puck
