#include "services/arm/back_end.h"

#include <stdexcept>

#include "common/motion/joint_table.h"
#include "common/yarp/yarp_back_end.h"

namespace puck {

std::unique_ptr<ArmBackEnd> make_back_end(const BackEndParams& params,
                                          const ArmControllerParams& controller,
                                          bool authenticated) {
  if (params.name == "simulated") return nullptr;
  if (!authenticated && !params.allow_unauthenticated) {
    throw std::invalid_argument(
        "arm.back_end \"yarp\" moves a real arm: give lcm.key_file, so that only those who have "
        "the key move it, or set arm.allow_unauthenticated = true");
  }
  YarpParams yarp = params.yarp;
  const JointTable joints(controller.arm.joints);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    yarp.lowest_deg.push_back(joints.limits(k).lowest);
    yarp.highest_deg.push_back(joints.limits(k).highest);
  }
  return std::make_unique<YarpBackEnd>(yarp);
}

}  // namespace puck
