#pragma once

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

}  // namespace puck
