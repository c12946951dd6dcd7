#pragma once

namespace puck {

/// How the head moves: a slow sway in yaw, a smaller one in pitch and roll, and joint vibration in
/// all three.
struct HeadMotionParams {
  double yaw_peak_to_peak_deg = 6;
  double yaw_period_s = 3;
  double pitch_peak_to_peak_deg = 1.5;
  double pitch_period_s = 2.3;
  double roll_peak_to_peak_deg = 0.6;
  double roll_period_s = 3.7;
  double vibration_deg = 0.1;  ///< Amplitude of the vibration in yaw and pitch; half in roll.
  double vibration_hz = 10;
};

}  // namespace puck
