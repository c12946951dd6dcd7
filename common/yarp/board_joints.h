#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "common/yarp/board_requests.h"
#include "common/yarp/yarp_params.h"

namespace puck {

/// A board's description of its joints.
struct BoardJoints {
  std::size_t axes = 0;            ///< Number of all its joints.
  std::vector<std::string> names;  ///< Of the driven joints: `joint 2 "elbow"`.
};

/// Requests it from the board. Throws YarpError that needs a person when a driven joint does not
/// exist or our limits are wider than the board's.
BoardJoints find_joints(const YarpParams& params, BoardRequests& requests);

}  // namespace puck
