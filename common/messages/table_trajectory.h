#pragma once

#include <optional>
#include <vector>

#include "common/events/timestamp.h"
#include "common/messages/message_header.h"
#include "common/table/intercept_predictor.h"
#include "common/table/puck_track.h"

namespace puck {

/// TRAJECTORY: the puck's motion on the table and its crossing of the robot's line.
struct TableTrajectory : MessageHeader {
  MessageId estimate;       ///< The estimate that it is based on.
  Timestamp at;             ///< Time of the motion.
  bool head_known = false;  ///< False: the head pose, and so the table's place, is not known.
  std::optional<PuckTrack> track;  ///< Empty: no track.
  bool is_coasting = false;        ///< Predicted through a short loss.
  std::vector<PathPoint> path;     ///< Predicted, for viewers; up to 4096 points.
  double line_x_m = 0;             ///< The robot's line: x = line_x_m.
  std::optional<Intercept> crossing;
};

}  // namespace puck
