#pragma once

#include "common/events/timestamp.h"
#include "common/table/puck_track.h"

namespace puck {

/// A measurement of the puck's position on the table.
struct TableMeasurement {
  Timestamp t;
  TablePoint position;
  Matrix2 covariance = Matrix2::Zero();  ///< Covariance of (x, y), m².
  TableVelocity velocity{};              ///< Used only where a track starts.
  bool resting = false;                  ///< The tracker reports a puck at rest.
  /// Covariance of the velocity, m²/s²; zeros if unknown.
  Matrix2 velocity_covariance = Matrix2::Zero();
};

/// Whether all numbers are finite and the covariance is valid.
bool is_usable(const TableMeasurement& measurement);

/// Whether a position measured with covariance `noise` lies within the given number of standard
/// deviations of the prediction.
bool is_within(const PuckTrack& predicted, const TablePoint& place, const Matrix2& noise,
               double sigmas);

/// The Kalman update of a track with a position. `noise`: the covariance of its error.
PuckTrack with_measurement(const PuckTrack& predicted, const TablePoint& place,
                           const Matrix2& noise);

}  // namespace puck
