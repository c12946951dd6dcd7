#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/yarp/board_requests.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// What a board says of its joints.
struct BoardJoints {
  std::size_t axes = 0;            ///< All that it has.
  std::vector<std::string> names;  ///< Of the driven ones: `joint 2 "elbow"`.
};

/// Asks for them. Throws BoardError that needs a person when a driven joint is not there or our
/// limits are wider than its own.
BoardJoints find_joints(const YarpParams& params, BoardRequests& requests);

}  // namespace puck
