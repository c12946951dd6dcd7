#pragma once

#include "common/table/puck_motion.h"

namespace puck {

/// The puck's centre stays within x 0.1 to 1.9 and y -0.4 to 0.4; it meets the mallet at x = 0.3.
inline constexpr TableGeometry kTable{2.0, 1.0, 0.4, 0.1, 0.05, 0.15, 0.3};
inline constexpr PuckMotionParams kIdeal{0, 1, 1, 0, 0};

inline PuckTrack track_at(double x, double y, double vx, double vy) {
  return {{{x, y}, {vx, vy}}, {}};
}

}  // namespace puck
