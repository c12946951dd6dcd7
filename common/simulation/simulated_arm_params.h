#pragma once

namespace puck {

/// The simulated arm that carries the robot's mallet along the robot's line.
struct SimulatedArmParams {
  double max_speed_m_s = 1.5;
  double max_acceleration_m_s2 = 20;
  double max_jerk_m_s3 = 2000;  ///< Reaches the highest acceleration in 10 ms.
};

}  // namespace puck
