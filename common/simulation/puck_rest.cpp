#include "common/simulation/puck_rest.h"

#include <cmath>

namespace puck {
namespace {

// Range of the table's length in which the puck may come to rest.
constexpr double kNearest = 0.58;
constexpr double kFarthest = 0.8;
constexpr double kFromSide_m = 0.15;
// As on a table whose air is off.
constexpr double kDamping_1_s = 12;
constexpr double kResting_m_s = 0.02;

}  // namespace

PuckRest::PuckRest(const TableGeometry& table, const GameParams& params, Random random)
    : table_(table), params_(params), random_(random) {}

void PuckRest::step(std::optional<DiscState>& puck, double dt_s) {
  const bool is_here = puck && puck->position.x_m > table_.length_m / 2;
  if (is_here && !puck_is_here_ && random_.uniform() < params_.rest_probability) {
    is_on_ = true;
    rest_s_ = random_.uniform(params_.rest_min_s, params_.rest_max_s);
  }
  puck_is_here_ = is_here;
  if (!is_here) is_on_ = false;
  if (!is_on_ || !is_in_reach(puck->position)) return;
  if (std::hypot(puck->velocity.x_m_s, puck->velocity.y_m_s) > kResting_m_s) {
    const double keep = 1 / (1 + kDamping_1_s * dt_s);
    puck->velocity.x_m_s *= keep;
    puck->velocity.y_m_s *= keep;
    return;
  }
  puck->velocity = {};
  rest_s_ -= dt_s;
  is_on_ = rest_s_ > 0;
}

bool PuckRest::is_in_reach(TablePoint place) const {
  return place.x_m > kNearest * table_.length_m && place.x_m < kFarthest * table_.length_m &&
         std::abs(place.y_m) < table_.width_m / 2 - kFromSide_m;
}

}  // namespace puck
