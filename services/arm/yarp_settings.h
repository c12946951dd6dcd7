#pragma once

#include "common/io/config.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// Reads keys arm.yarp.*: the robot's control board. The limits of the joints come from the joint
/// table.
YarpParams read_yarp_params(Config& config);

}  // namespace puck
