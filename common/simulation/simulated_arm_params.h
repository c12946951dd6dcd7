#pragma once

namespace puck {

/// The simulated arm that carries the robot's mallet along the robot's line.
struct SimulatedArmParams {
  double max_speed_m_s = 1.5;
  double max_acceleration_m_s2 = 20;
  double stiffness_1_s = 25;  ///< Natural frequency of the follower; larger follows more closely.
};

}  // namespace puck
