#include "services/arm/yarp_settings.h"

#include <cmath>
#include <vector>

#include "common/yarp/state_message.h"

namespace puck {

YarpParams read_yarp_params(Config& config) {
  YarpParams params;
  config.read("arm.yarp.host", params.host);
  config.read("arm.yarp.port", params.port, 1, 65535);
  config.read("arm.yarp.robot", params.robot);
  config.read("arm.yarp.part", params.part);
  config.read("arm.yarp.local_name", params.local_name);
  std::vector<double> joints(params.joints.begin(), params.joints.end());
  config.read("arm.yarp.joints", joints, 0, static_cast<double>(kMostBoardJoints - 1));
  params.joints.clear();
  for (const double joint : joints) {
    if (joint != std::floor(joint)) config.fail("arm.yarp.joints", "must be whole numbers");
    params.joints.push_back(static_cast<int>(joint));
  }
  config.read("arm.yarp.silent_ms", params.silent_ms, 40, 1000);
  config.read("arm.yarp.connect_timeout_ms", params.connect_timeout_ms, 10, 60'000);
  config.read("arm.yarp.answer_timeout_ms", params.answer_timeout_ms, 10, 60'000);
  config.read("arm.yarp.retry_ms", params.retry_ms, 10, 5000);
  config.read("arm.yarp.check_modes_ms", params.check_modes_ms, 10, 10'000);
  config.read("arm.yarp.start_within_deg", params.start_within_deg, 0.1, 10);
  config.read("arm.yarp.max_step_deg", params.max_step_deg, 0.1, 10);
  return params;
}

}  // namespace puck
