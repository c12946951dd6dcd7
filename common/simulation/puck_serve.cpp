#include "common/simulation/puck_serve.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace puck {

// The path parameter is a quarter of a sine in time: fastest at the start, at rest at the end.
DiscState PuckServe::step(double step_s) {
  left_s_ = std::max(0.0, left_s_ - step_s);
  const double phase = std::numbers::pi / 2 * (1 - left_s_ / kDuration_s);
  const double share = std::sin(phase);
  const double rate_1_s = std::numbers::pi / 2 / kDuration_s * std::cos(phase);
  const auto place = [&](double from, double around, double to) {
    const double rest = 1 - share;
    return rest * rest * from + 2 * rest * share * around + share * share * to;
  };
  const auto speed = [&](double from, double around, double to) {
    return 2 * rate_1_s * ((1 - share) * (around - from) + share * (to - around));
  };
  return {{place(from_.x_m, around_.x_m, to_.x_m), place(from_.y_m, around_.y_m, to_.y_m)},
          {speed(from_.x_m, around_.x_m, to_.x_m), speed(from_.y_m, around_.y_m, to_.y_m)}};
}

}  // namespace puck
