#pragma once

#include "common/simulation/puck_physics.h"

namespace puck {

/// How a puck comes back into play: pushed from behind the opponent's mallet, around it, to where
/// it is left at rest, so that a camera sees it come.
class PuckServe {
 public:
  PuckServe() = default;
  /// It sets out towards `around` and comes from there: a parabola's arc.
  PuckServe(TablePoint from, TablePoint around, TablePoint to)
      : from_(from), around_(around), to_(to), left_s_(kDuration_s) {}

  bool is_under_way() const { return left_s_ > 0; }

  /// Where the puck is after another `step_s`.
  DiscState step(double step_s);

 private:
  static constexpr double kDuration_s = 0.5;

  TablePoint from_;
  TablePoint around_;
  TablePoint to_;
  double left_s_ = 0;
};

}  // namespace puck
