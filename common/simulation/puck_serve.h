#pragma once

#include "common/simulation/puck_physics.h"

namespace puck {

/// How a puck comes into play: pushed around the opponent's mallet to where it comes to rest, so
/// that a camera sees it arrive.
class PuckServe {
 public:
  PuckServe() = default;
  /// The path is a parabola (a quadratic Bézier curve) with `around` as its control point.
  PuckServe(TablePoint from, TablePoint around, TablePoint to)
      : from_(from), around_(around), to_(to), left_s_(kDuration_s) {}

  bool is_under_way() const { return left_s_ > 0; }

  /// The puck's state after another `step_s`.
  DiscState step(double step_s);

 private:
  static constexpr double kDuration_s = 0.5;

  TablePoint from_;
  TablePoint around_;
  TablePoint to_;
  double left_s_ = 0;
};

}  // namespace puck
