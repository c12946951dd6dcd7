#pragma once

#include <vector>

namespace puck {

/// A place on the robot's line and the joint angles measured with the mallet there.
struct JointPair {
  double y_m = 0;
  std::vector<double> deg{};
};

}  // namespace puck
