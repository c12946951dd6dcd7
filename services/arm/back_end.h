#pragma once

#include <memory>
#include <string>

#include "common/control/arm_back_end.h"
#include "common/control/arm_controller.h"
#include "common/yarp/yarp_params.h"

namespace puck {

struct BackEndParams {
  std::string name = "simulated";  ///< Key arm.back_end: simulated, yarp.
  /// Key arm.allow_unauthenticated: a real arm accepts commands from any host.
  bool allow_unauthenticated = false;
  YarpParams yarp;  ///< Keys arm.yarp.*; the limits come from the joint table.
};

/// The arm's back end; null: the controller's own simulated joints. Throws std::invalid_argument
/// that names the key when a value is out of its range, and for a real arm on a bus that is not
/// `authenticated`, unless allowed: access to the network alone must not move a robot.
std::unique_ptr<ArmBackEnd> make_back_end(const BackEndParams& params,
                                          const ArmControllerParams& controller,
                                          bool authenticated);

}  // namespace puck
