#pragma once

#include "common/table/puck_motion.h"

namespace puck {

/// Constants of one table and its puck; see PuckMotionParams.
struct MotionConstants {
  double damping_per_s = 0;
  double rail_restitution = 0;
  double rail_grip = 0;
};

/// Deviation of a bounce from the fitted constants, as PuckMotionParams::bounce_spread. Larger than
/// in the simulated game, whose bounces are all alike: unmeasured spin changes a real bounce by 2 %
/// of the speed along the rail where the puck rolled along it.
constexpr double kFittedBounceSpread = 0.015;

/// The parameters with the table's own constants.
constexpr PuckMotionParams with_constants(PuckMotionParams params,
                                          const MotionConstants& constants) {
  params.damping_per_s = constants.damping_per_s;
  params.rail_restitution = constants.rail_restitution;
  params.rail_grip = constants.rail_grip;
  params.bounce_spread = kFittedBounceSpread;
  return params;
}

}  // namespace puck
