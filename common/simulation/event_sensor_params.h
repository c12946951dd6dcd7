#pragma once

namespace puck {

/// An event sensor at an illuminance of LightParams::kReference_lux. Contrast is in units of
/// ln(intensity).
struct EventSensorParams {
  double threshold = 0.2;            ///< Change of ln(intensity) that makes one event.
  double threshold_mismatch = 0.03;  ///< Standard deviation of the threshold across pixels.
  double cutoff_hz = 500;            ///< Cutoff of the photoreceptor's first-order low-pass.
  /// Luminance at which `cutoff_hz` holds. A pixel's cutoff is proportional to the luminance on it,
  /// so that the leading edge of a dark object is reported later than its trailing edge. 0: the
  /// cutoff is the same everywhere.
  double cutoff_luminance = 0;
  double refractory_us = 100;        ///< Time after an event in which the pixel fires no other.
  double noise_hz = 0.1;             ///< Background events per pixel and second.
  double hot_pixel_fraction = 2e-5;  ///< Share of pixels that fire all the time.
  double hot_pixel_hz = 500;         ///< Mean rate of each hot pixel.
  double jitter_us = 20;  ///< Mean delay of a timestamp; delays are uniform from 0 to 2 × this.
  double readout_mev_s = 50;  ///< Limit of the readout; events above it wait.
};

}  // namespace puck
