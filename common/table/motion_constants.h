#pragma once

#include "common/table/puck_motion.h"

namespace puck {

/// What one table and its puck make of the puck's motion; see PuckMotionParams.
struct MotionConstants {
  double damping_per_s = 0;
  double rail_restitution = 0;
  double rail_grip = 0;
};

/// How much a bounce differs from the fitted one, as PuckMotionParams::bounce_spread: more than in
/// the simulated game, whose bounces are all alike. A spin that nobody measures changes a real one:
/// by 2 % of the speed along the rail where the puck rolled along it.
constexpr double kFittedBounceSpread = 0.015;

/// The parameters with a table's own constants.
constexpr PuckMotionParams with_constants(PuckMotionParams params,
                                          const MotionConstants& constants) {
  params.damping_per_s = constants.damping_per_s;
  params.rail_restitution = constants.rail_restitution;
  params.rail_grip = constants.rail_grip;
  params.bounce_spread = kFittedBounceSpread;
  return params;
}

}  // namespace puck
