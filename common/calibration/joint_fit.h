#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "common/motion/joint_pair.h"
#include "common/motion/joint_table.h"

namespace puck {

struct JointFitParams {
  /// Of the spline; 0: one for every two places that were measured, at most 16.
  int intervals = 0;
  /// A joint may go so far beyond what was measured, deg. A spline that needs more is refused.
  double margin_deg = 2;
  /// Of every joint; the ends are not used.
  MotionLimits limits{0, 0, 60, 600, 12'000};
};

struct JointResidual {
  /// As measured, but for steps back of 2 % of the way in all; then the spline is, wholly.
  bool is_monotone = false;
  double rms_deg = 0;
  double max_deg = 0;
};

struct JointFit {
  JointTableParams table;
  std::vector<JointResidual> residuals;
  std::size_t places = 0;    ///< Different ones.
  double longest_gap_m = 0;  ///< Between neighbouring places.
};

/// Fits a cubic spline with even knots to each joint by least squares. The coefficients of a joint
/// that was measured to grow or fall all along the line are then put in order, so that it does so
/// between the places, too. Throws std::invalid_argument with the reason: numbers that are not
/// finite or rows of different lengths, fewer than four places or less than 20 mm between the
/// outermost, a gap of more than a third of the line, more intervals than places can fix, or no
/// table: see JointTable.
JointFit fit_joint_table(std::span<const JointPair> pairs, const JointFitParams& params);

}  // namespace puck
