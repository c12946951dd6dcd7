#pragma once

namespace puck {

/// An event sensor in room light of LightParams::kReference_lux. Contrast is in units of
/// ln(intensity).
struct EventSensorParams {
  double threshold = 0.2;            ///< Change of ln(intensity) that makes one event.
  double threshold_mismatch = 0.03;  ///< Standard deviation of the threshold from pixel to pixel.
  double cutoff_hz = 500;            ///< Of the photoreceptor's first-order low-pass.
  /// Where `cutoff_hz` holds; a pixel's own goes with the light on it, so that a dark thing's front
  /// is told later than its back. 0: it is the same everywhere.
  double cutoff_luminance = 0;
  double refractory_us = 100;        ///< A pixel is silent for so long after an event.
  double noise_hz = 0.1;             ///< Background events per pixel and second.
  double hot_pixel_fraction = 2e-5;  ///< Pixels that fire all the time.
  double hot_pixel_hz = 500;         ///< How often each of them fires.
  double jitter_us = 20;             ///< Timestamps are late by 0 to 2 × this, on average by this.
  double readout_mev_s = 50;         ///< No more events than this leave the sensor; others wait.
};

}  // namespace puck
