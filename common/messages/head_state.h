#pragma once

#include <optional>

#include "common/events/timestamp.h"
#include "common/messages/message_header.h"
#include "common/table/head_pose.h"

namespace puck {

/// HEAD: pose of the camera, from the robot's encoders or the simulated head.
struct HeadState : MessageHeader, HeadPose {
  std::optional<Timestamp> at;  ///< Empty: not known.
};

}  // namespace puck
