#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "common/motion/joint_pair.h"
#include "common/motion/joint_table.h"

namespace puck {

struct JointFitParams {
  /// Intervals of the spline; 0: one for every two measured places, at most 16.
  int intervals = 0;
  /// Largest excess of the spline over the measured range, deg; more is refused.
  double margin_deg = 2;
  /// Limits of every joint; the ends are not used.
  MotionLimits limits{0, 0, 60, 600, 12'000};
};

struct JointResidual {
  /// Whether the measured angles are monotone, except steps back of up to 2 % of the range in all;
  /// the spline is then exactly monotone.
  bool is_monotone = false;
  double rms_deg = 0;
  double max_deg = 0;
};

struct JointFit {
  JointTableParams table;
  std::vector<JointResidual> residuals;
  std::size_t places = 0;    ///< Number of different places.
  double longest_gap_m = 0;  ///< Between neighbouring places.
};

/// Fits a cubic spline with uniform knots to each joint by least squares. The control points of a
/// joint that was measured to be monotone along the line are then put in order, so that the spline
/// is monotone between the places too. Throws std::invalid_argument with the reason: numbers that
/// are not finite or rows of different lengths, fewer than four places or less than 20 mm between
/// the outermost, a gap of more than a third of the line, more intervals than the places can fix,
/// or an invalid table (see JointTable).
JointFit fit_joint_table(std::span<const JointPair> pairs, const JointFitParams& params);

}  // namespace puck
