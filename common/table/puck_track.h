#pragma once

#include "common/table/matrix4.h"
#include "common/table/table_point.h"

namespace puck {

/// Where the puck's centre is on the table and how it moves.
struct PuckState {
  TablePoint position;
  TableVelocity velocity;
};

/// A state and how sure it is.
struct PuckTrack {
  PuckState state;
  /// Of (x, y, vx, vy), row by row; m², m²/s, m²/s².
  Matrix4 covariance{};
};

}  // namespace puck
