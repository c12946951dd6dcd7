#pragma once

#include "common/motion/joint_table.h"

namespace puck {

/// The seven joints of the simulated arm: config/calibration/simulated_arm.toml.
JointTableParams simulated_joints();

}  // namespace puck
