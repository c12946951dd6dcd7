#pragma once

#include <cstdint>

#include "common/messages/message_header.h"
#include "common/table/puck_track.h"
#include "common/vision/geometry/truth_row.h"

namespace puck {

/// TRUTH: exact state of the simulated world.
struct GroundTruth : MessageHeader, TruthRow {
  bool in_play = false;  ///< False: off the table, after a goal.
  PuckState on_table;

  // So far.
  std::int32_t shots = 0;  ///< At the robot's goal.
  std::int32_t saves = 0;
  std::int32_t goals_against = 0;  ///< The opponent's.
  std::int32_t goals_for = 0;      ///< The robot's.
};

}  // namespace puck
