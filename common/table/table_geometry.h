#pragma once

#include <cmath>

#include "common/table/table_point.h"

namespace puck {

/// The table, the puck and the robot's line, m, in the frame of TablePoint. The defaults are the
/// paper's table and puck.
struct TableGeometry {
  double length_m = 2.135;     ///< Between the end rails: x from 0 to this.
  double width_m = 1.22;       ///< Between the side rails: |y| up to half of this.
  double goal_width_m = 0.40;  ///< Opening in the middle of both end rails.
  double puck_radius_m = 0.0325;
  double mallet_radius_m = 0.05;
  double robot_line_x_m = 0.15;     ///< x of the robot's mallet.
  double robot_line_half_m = 0.30;  ///< The robot's mallet moves with |y| up to this.

  /// x of the puck's centre when the rim of an approaching puck touches a robot's mallet in its
  /// way.
  double contact_line_x_m() const { return robot_line_x_m + puck_radius_m + mallet_radius_m; }

  /// Whether a point lies on the playing surface or at most `margin_m` beyond it.
  bool contains(const TablePoint& point, double margin_m) const {
    return point.x_m >= -margin_m && point.x_m <= length_m + margin_m &&
           std::abs(point.y_m) <= width_m / 2 + margin_m;
  }
};

}  // namespace puck
