#pragma once

#include "common/table/matrix.h"
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
  /// Covariance of (x, y, vx, vy); m², m²/s, m²/s².
  Matrix4 covariance = Matrix4::Zero();
};

/// The larger variance of both parts of the velocity, m²/s².
inline double largest_speed_variance(const PuckTrack& track) {
  return track.covariance.diagonal().tail<2>().maxCoeff();
}

}  // namespace puck
