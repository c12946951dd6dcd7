#pragma once

namespace puck {

/// The table, the puck and the robot's line, m, in the frame of TablePoint. The defaults are the
/// paper's table and puck.
struct TableGeometry {
  double length_m = 2.135;     ///< Between the end rails: x from 0 to this.
  double width_m = 1.22;       ///< Between the side rails: y within half of it to both sides.
  double goal_width_m = 0.40;  ///< Opening in the middle of both end rails.
  double puck_radius_m = 0.0325;
  double mallet_radius_m = 0.05;
  double robot_line_x_m = 0.15;     ///< The robot's mallet moves on x = this …
  double robot_line_half_m = 0.30;  ///< … with |y| up to this.
};

}  // namespace puck
