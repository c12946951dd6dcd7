#pragma once

#include <cstddef>
#include <vector>

#include "common/calibration/flight_finder.h"
#include "common/table/motion_constants.h"
#include "common/table/table_geometry.h"

namespace puck {

struct MotionFit {
  MotionConstants constants;
  /// From the disagreement between the flights, so that persistent tracker errors do not count as
  /// many small independent ones.
  MotionConstants standard_error;
  std::size_t flights = 0;   ///< Flights used in the fit.
  std::size_t bounces = 0;   ///< Bounces in those flights.
  std::size_t rejected = 0;  ///< Flights left out: a mallet beside a rail, a lost track.
  double rms_m = 0;          ///< Residual between the positions and the fitted flights.
};

/// Fits the constants of gliding and bouncing: PuckMotion predicts each flight from its start,
/// which is fitted too. Throws std::invalid_argument with the reason: fewer than twelve flights
/// with bounces, constants with a standard error of more than 0.05 (the damping, 1/s: more than
/// 0.1), or constants that are impossible for a table.
MotionFit fit_motion(const std::vector<Flight>& flights, const TableGeometry& table);

}  // namespace puck
