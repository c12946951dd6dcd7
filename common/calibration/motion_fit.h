#pragma once

#include <cstddef>
#include <vector>

#include "common/calibration/flight_finder.h"
#include "common/table/motion_constants.h"
#include "common/table/table_geometry.h"

namespace puck {

struct MotionFit {
  MotionConstants constants;
  /// From how much the flights disagree with one another, so that errors of the tracker that last
  /// are not taken for many small ones.
  MotionConstants standard_error;
  std::size_t flights = 0;   ///< That the fit rests on.
  std::size_t bounces = 0;   ///< In them.
  std::size_t rejected = 0;  ///< Flights that are none: a mallet beside a rail, a lost track.
  double rms_m = 0;          ///< Of the distances between the places and the fitted flights.
};

/// Fits how the puck glides and bounces: PuckMotion flies each flight from where and how it began,
/// which is fitted, too. Throws std::invalid_argument with the reason: fewer than twelve flights
/// with bounces, constants that these leave open by more than 0.05 (the damping, 1/s: by more than
/// 0.1), or that no table can have.
MotionFit fit_motion(const std::vector<Flight>& flights, const TableGeometry& table);

}  // namespace puck
