#include "common/simulation/puck_serve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace puck {

// Half a cosine in place: it starts and ends at rest.
DiscState PuckServe::step(double step_s) {
  left_s_ = std::max(0.0, left_s_ - step_s);
  const double phase = std::numbers::pi * (1 - left_s_ / kDuration_s);
  const double share = 0.5 * (1 - std::cos(phase));
  const double rate_1_s = 0.5 * std::numbers::pi / kDuration_s * std::sin(phase);
  const double dx_m = to_.x_m - from_.x_m;
  const double dy_m = to_.y_m - from_.y_m;
  return {{from_.x_m + share * dx_m, from_.y_m + share * dy_m}, {rate_1_s * dx_m, rate_1_s * dy_m}};
}

}  // namespace puck
