#pragma once

#include <cstdint>

#include "common/events/timestamp.h"
#include "common/table/table_point.h"
#include "common/vision/pixel.h"

namespace puck {

/// Rotation of the camera from its home pose: yaw first, then pitch, then roll. Yaw is positive to
/// the right, pitch up, roll clockwise as the camera sees it.
struct HeadPose {
  double yaw_deg = 0;
  double pitch_deg = 0;
  double roll_deg = 0;
  double yaw_deg_s = 0;
  double pitch_deg_s = 0;
  double roll_deg_s = 0;
};

/// What has happened in the game so far.
struct GameCounts {
  std::int32_t shots = 0;          ///< Hits of the opponent that would enter the robot's goal.
  std::int32_t saves = 0;          ///< Shots that the robot's mallet turned away.
  std::int32_t goals_against = 0;  ///< Into the robot's goal.
  std::int32_t goals_for = 0;      ///< Into the opponent's goal.

  friend constexpr bool operator==(const GameCounts&, const GameCounts&) = default;
};

/// The simulated world as it really is at one moment.
struct SimulatedTruth {
  Timestamp time;

  /// Centre and full axes of the upright box around the puck's silhouette, as a person would mark
  /// it; also where the puck is covered or outside the image.
  Pixel position_px;
  PuckSize size_px;
  double visible = 0;  ///< Share of the silhouette that nothing covers, inside the image: 0 to 1.

  bool in_play = false;  ///< False while the puck is off the table, after a goal.
  TablePoint position;   ///< Of the puck's centre.
  TableVelocity velocity;
  TablePoint robot_mallet;
  TablePoint opponent_mallet;

  HeadPose head;
  GameCounts counts;
};

}  // namespace puck
