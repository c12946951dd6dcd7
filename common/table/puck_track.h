#pragma once

#include "common/table/matrix4.h"
#include "common/table/table_point.h"

namespace puck {

/// Position and velocity of the puck's centre on the table.
struct PuckState {
  TablePoint position;
  TableVelocity velocity;
};

/// A state and its uncertainty.
struct PuckTrack {
  PuckState state;
  /// Covariance of (x, y, vx, vy), row-major; m², m²/s, m²/s².
  Matrix4 covariance{};
};

}  // namespace puck
