#pragma once

namespace puck {

/// A point on the table, m. Origin on the playing surface at the middle of the robot's end, x
/// towards the opponent, y to the robot's left.
struct TablePoint {
  double x_m = 0;
  double y_m = 0;

  friend constexpr bool operator==(TablePoint, TablePoint) = default;
};

/// A velocity on the table, m/s, in the frame of TablePoint.
struct TableVelocity {
  double x_m_s = 0;
  double y_m_s = 0;
};

}  // namespace puck
