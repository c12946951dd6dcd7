#pragma once

namespace puck {

/// A pinhole camera above the middle of the robot's end, looking towards the opponent. The defaults
/// show the whole width of the table from 0.5 m beyond the robot's end on, and the puck from 17 x 8
/// px at the far end to 47 x 42 px at the near one.
struct CameraParams {
  double focal_px = 740;
  double behind_m = 0.68;   ///< Distance behind the robot's end of the table.
  double height_m = 0.80;   ///< Above the playing surface.
  double pitch_deg = 32.5;  ///< Down from the horizontal.
};

}  // namespace puck
