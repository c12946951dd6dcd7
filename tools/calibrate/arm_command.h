#pragma once

#include <filesystem>
#include <string>

#include "common/calibration/joint_fit.h"

namespace puck {

struct ArmFitCommand {
  std::filesystem::path pairs;
  std::filesystem::path output;
  JointFitParams fit;
  std::string part = "arm";  ///< Columns of the authors' table: torso, arm or head.
  double centre_m = 0;       ///< The y in the pairs at the middle of the line.
  bool mirror = false;       ///< The y in the pairs grows to the robot's right.
};

/// Fits the arm's joints to measured pairs along the robot's line, writes the joint table, and
/// prints its residuals and the mallet's limits. `typed`: the command line, for a comment in the
/// file. Throws CsvError or ConfigError, which name the file, or std::invalid_argument for too few
/// pairs.
void calibrate_arm(const ArmFitCommand& command, const std::string& typed);

}  // namespace puck
