#pragma once

#include <array>

#include "common/events/timestamp.h"
#include "common/table/puck_track.h"

namespace puck {

/// Where one estimate places the puck on the table.
struct TableMeasurement {
  Timestamp t;
  TablePoint position;
  Matrix2 covariance{};           ///< Of (x, y), m².
  TableVelocity velocity{};       ///< Used only where a track begins.
  bool resting = false;           ///< The tracker saw that the puck lies still.
  Matrix2 velocity_covariance{};  ///< Of the velocity, m²/s²; all zeros where it is not known.
};

/// Whether all is finite and the place's covariance can be one.
bool is_usable(const TableMeasurement& measurement);

/// Whether a place that is measured with such an error lies within so many standard deviations.
bool is_within(const PuckTrack& predicted, const TablePoint& place, const Matrix2& noise,
               double sigmas);

/// The track with the measured place taken in. `noise`: the covariance of its error.
PuckTrack with_measurement(const PuckTrack& predicted, const TablePoint& place,
                           const Matrix2& noise);

}  // namespace puck
