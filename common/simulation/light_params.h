#pragma once

namespace puck {

/// The room's light. The sensor's photoreceptors are slower, noisier and less punctual in dim
/// light; lamps on the mains flicker.
struct LightParams {
  /// What the bandwidth, noise and jitter of EventSensorParams are given at.
  static constexpr double kReference_lux = 300;

  double illuminance_lux = kReference_lux;
  double flicker_modulation = 0;  ///< The light goes from 1 − this to 1 + this times its mean.
  double flicker_hz = 100;        ///< Twice the mains' frequency.
};

}  // namespace puck
