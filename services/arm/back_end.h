#pragma once

#include <memory>
#include <string>

#include "common/control/arm_back_end.h"
#include "common/control/arm_controller.h"
#include "common/yarp/yarp_params.h"

namespace puck {

struct BackEndParams {
  std::string name = "simulated";  ///< Key arm.back_end: simulated, yarp.
  /// Key arm.allow_unauthenticated: a real arm is moved by whoever is on the network.
  bool allow_unauthenticated = false;
  YarpParams yarp;  ///< Keys arm.yarp.*, without the limits, which are the joint table's.
};

/// What moves the arm; nothing: the controller's own simulated joints. Throws std::invalid_argument
/// that names the key when a value is out of its range, and for a real arm on a bus that is not
/// `authenticated`, unless that is allowed: who reaches the network must not thereby move a robot.
std::unique_ptr<ArmBackEnd> make_back_end(const BackEndParams& params,
                                          const ArmControllerParams& controller,
                                          bool authenticated);

}  // namespace puck
