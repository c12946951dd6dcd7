#pragma once

#include <array>

#include "common/simulation/head_motion_params.h"
#include "common/simulation/random.h"
#include "common/simulation/simulated_truth.h"

namespace puck {

/// The pose of a moving head as a sum of sines whose phases are drawn once.
class HeadMotion {
 public:
  HeadMotion(const HeadMotionParams& params, Random random);

  HeadPose pose_at(double t_s) const;
  /// Upper bounds of |yaw|, |pitch| and |roll|.
  HeadPose limits() const;

 private:
  struct Wave {
    double amplitude_deg = 0;
    double omega_1_s = 0;
    double phase = 0;
  };
  using Waves = std::array<Wave, 4>;
  struct Angle {
    double deg = 0;
    double deg_s = 0;
  };

  static Waves waves_of(double peak_to_peak_deg, double period_s, double vibration_deg,
                        double vibration_hz, Random& random);
  static Angle sum_of(const Waves& waves, double t_s);
  static double bound_of(const Waves& waves);

  Waves yaw_;
  Waves pitch_;
  Waves roll_;
};

}  // namespace puck
