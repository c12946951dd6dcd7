#include "common/simulation/head_motion.h"

#include <cmath>
#include <numbers>

namespace puck {

HeadMotion::HeadMotion(const HeadMotionParams& params, Random random)
    : yaw_(waves_of(params.yaw_peak_to_peak_deg, params.yaw_period_s, params.vibration_deg,
                    params.vibration_hz, random)),
      pitch_(waves_of(params.pitch_peak_to_peak_deg, params.pitch_period_s, params.vibration_deg,
                      params.vibration_hz, random)),
      roll_(waves_of(params.roll_peak_to_peak_deg, params.roll_period_s, params.vibration_deg / 2,
                     params.vibration_hz, random)) {}

HeadPose HeadMotion::pose_at(double t_s) const {
  const Angle yaw = sum_of(yaw_, t_s);
  const Angle pitch = sum_of(pitch_, t_s);
  const Angle roll = sum_of(roll_, t_s);
  return {yaw.deg, pitch.deg, roll.deg, yaw.deg_s, pitch.deg_s, roll.deg_s};
}

HeadPose HeadMotion::limits() const {
  return {bound_of(yaw_), bound_of(pitch_), bound_of(roll_), 0, 0, 0};
}

// Two slow waves and two of vibration whose frequencies have no common period, so that no pose
// repeats exactly.
HeadMotion::Waves HeadMotion::waves_of(double peak_to_peak_deg, double period_s,
                                       double vibration_deg, double vibration_hz, Random& random) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const double amplitude_deg = peak_to_peak_deg / 2;
  Waves waves{Wave{0.85 * amplitude_deg, kTurn / period_s},
              Wave{0.15 * amplitude_deg, 2.37 * kTurn / period_s},
              Wave{0.6 * vibration_deg, 0.83 * kTurn * vibration_hz},
              Wave{0.4 * vibration_deg, 1.31 * kTurn * vibration_hz}};
  for (Wave& wave : waves) wave.phase = random.uniform(0, kTurn);
  return waves;
}

HeadMotion::Angle HeadMotion::sum_of(const Waves& waves, double t_s) {
  Angle sum;
  for (const Wave& wave : waves) {
    const double angle = wave.omega_1_s * t_s + wave.phase;
    sum.deg += wave.amplitude_deg * std::sin(angle);
    sum.deg_s += wave.amplitude_deg * wave.omega_1_s * std::cos(angle);
  }
  return sum;
}

double HeadMotion::bound_of(const Waves& waves) {
  double bound = 0;
  for (const Wave& wave : waves) bound += wave.amplitude_deg;
  return bound;
}

}  // namespace puck
