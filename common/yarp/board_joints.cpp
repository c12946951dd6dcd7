#include "common/yarp/board_joints.h"

#include "common/yarp/in_deg.h"
#include "common/yarp/yarp_error.h"

namespace puck {
namespace {

std::string in_words(const JointRange& range) {
  return in_deg(range.lowest_deg) + " to " + in_deg(range.highest_deg);
}

}  // namespace

BoardJoints find_joints(const YarpParams& params, BoardRequests& requests) {
  BoardJoints found{.axes = static_cast<std::size_t>(requests.axes())};
  for (std::size_t i = 0; i < params.joints.size(); ++i) {
    const int joint = params.joints[i];
    const std::string which = "joint " + std::to_string(joint);
    if (joint >= static_cast<int>(found.axes)) {
      throw YarpError(
          "there is no " + which + " of arm.yarp.joints among its " + std::to_string(found.axes),
          YarpError::Kind::kNeedsPerson);
    }
    found.names.push_back(which + " " + in_quotes(requests.name(joint)));
    const JointRange range = requests.range(joint);
    const JointRange ours{params.lowest_deg[i], params.highest_deg[i]};
    if (ours.lowest_deg < range.lowest_deg || ours.highest_deg > range.highest_deg) {
      throw YarpError(found.names.back() + " may go from " + in_words(range) +
                          ": our limits are wider, from " + in_words(ours),
                      YarpError::Kind::kNeedsPerson);
    }
  }
  return found;
}

}  // namespace puck
