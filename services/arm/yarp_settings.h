#pragma once

#include "common/io/config.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// Keys arm.yarp.*: where the robot's control board is. The limits of the joints are not among
/// them: they come from the joint table.
YarpParams read_yarp_params(Config& config);

}  // namespace puck
