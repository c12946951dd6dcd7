#pragma once

#include <cstdint>

#include "common/events/timestamp.h"
#include "common/table/head_pose.h"
#include "common/table/table_point.h"
#include "common/vision/geometry/pixel.h"

namespace puck {

/// Counts since the start of the game.
struct GameCounts {
  std::int32_t shots = 0;          ///< Opponent's hits that would enter the robot's goal.
  std::int32_t saves = 0;          ///< Shots that the robot's mallet turned away.
  std::int32_t goals_against = 0;  ///< Into the robot's goal.
  std::int32_t goals_for = 0;      ///< Into the opponent's goal.

  friend constexpr bool operator==(const GameCounts&, const GameCounts&) = default;
};

/// The true state of the simulated world at one moment.
struct SimulatedTruth {
  Timestamp time;

  /// Centre and full axes of the puck silhouette's upright bounding box, as a person would annotate
  /// it; also where the puck is covered or outside the image.
  Pixel position_px;
  PuckSize size_px;
  double visible = 0;  ///< Share of the silhouette inside the image and not covered, 0 to 1.

  bool in_play = false;  ///< False while the puck is off the table, after a goal.
  TablePoint position;   ///< The puck's centre.
  TableVelocity velocity;
  TablePoint robot_mallet;
  TablePoint opponent_mallet;

  HeadPose head;
  GameCounts counts;
};

}  // namespace puck
