#pragma once

#include <filesystem>
#include <string>

#include "common/calibration/joint_fit.h"

namespace puck {

struct ArmCommand {
  std::filesystem::path pairs;
  std::filesystem::path output;
  JointFitParams fit;
  std::string part = "arm";  ///< Of the authors' table: torso, arm, head.
  double centre_m = 0;       ///< The y of the pairs that is the middle of the line.
  bool mirror = false;       ///< The y of the pairs grows to the other side.
};

/// Fits the joints along the robot's line to measured pairs, writes the joint table, and prints how
/// good it is and how fast the mallet may be. `typed`: the command, for a comment. Throws CsvError
/// or ConfigError, which name the file, or std::invalid_argument for pairs that fix no table.
void calibrate_arm(const ArmCommand& command, const std::string& typed);

}  // namespace puck
