#include "common/simulation/puck_serve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace puck {

// A quarter of a sine in place: it comes out of the goal with a push and ends at rest.
DiscState PuckServe::step(double step_s) {
  left_s_ = std::max(0.0, left_s_ - step_s);
  const double phase = std::numbers::pi / 2 * (1 - left_s_ / kDuration_s);
  const double share = std::sin(phase);
  const double rate_1_s = std::numbers::pi / 2 / kDuration_s * std::cos(phase);
  const double dx_m = to_.x_m - from_.x_m;
  const double dy_m = to_.y_m - from_.y_m;
  return {{from_.x_m + share * dx_m, from_.y_m + share * dy_m}, {rate_1_s * dx_m, rate_1_s * dy_m}};
}

}  // namespace puck
