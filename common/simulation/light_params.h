#pragma once

namespace puck {

/// The room's light. In dim light the photoreceptors are slower and noisier, and their timestamps
/// jitter more; lamps on the mains flicker.
struct LightParams {
  /// The illuminance at which the bandwidth, noise and jitter of EventSensorParams hold.
  static constexpr double kReference_lux = 300;

  double illuminance_lux = kReference_lux;
  double flicker_modulation = 0;  ///< Amplitude of the flicker as a share of the mean illuminance.
  double flicker_hz = 100;        ///< Twice the mains frequency.
};

}  // namespace puck
