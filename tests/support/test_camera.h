#pragma once

#include <cmath>

#include "common/table/homography.h"

namespace puck {

/// A camera 0.6 m above the table and 0.6 m behind the robot's end, directed at the opponent and 30
/// degrees down, with 640 by 480 pixels and a focal length of 700 px.
inline Homography test_camera() {
  const double sine = 0.5;
  const double cosine = std::sqrt(0.75);
  const double focal_px = 700;
  const double height_m = 0.6;
  const double behind_m = 0.6;
  // The ray through a pixel meets the table at height / fall, where fall is its descent.
  const double fall_y = cosine;
  const double fall_0 = focal_px * sine - 240 * cosine;
  const double ahead_y = -sine;
  const double ahead_0 = focal_px * cosine + 240 * sine;
  return Homography({0, height_m * ahead_y - behind_m * fall_y,
                     height_m * ahead_0 - behind_m * fall_0,  //
                     -height_m, 0, height_m * 320,            //
                     0, fall_y, fall_0});
}

}  // namespace puck
