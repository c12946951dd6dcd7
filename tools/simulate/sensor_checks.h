#pragma once

#include <string>
#include <vector>

#include "tools/simulate/sensor_bench.h"

namespace puck {

/// Standard measurements of event cameras, on the simulated one. Each returns the measured and, if
/// theory gives it, the expected curve.
struct Curve {
  struct Point {
    double x = 0;
    double y = 0;
  };
  std::string name;
  std::vector<Point> points;
};

/// Distribution of the pixels by their number of events after a step of the light.
struct StepResponse {
  Curve measured;  ///< x: events, y: share of the pixels.
  Curve expected;
};
StepResponse step_response(const SensorBench::Set& set, double log_ratio);

/// Events per pixel and cycle against the swing of ln(light), far below the cutoff.
Curve contrast_response(const SensorBench::Set& set);

/// Events per cycle against frequency, relative to those far below the cutoff: x in Hz.
struct FrequencyResponse {
  Curve measured;
  Curve expected;  ///< Of a first-order low-pass.
  double corner_hz = 0;
};
FrequencyResponse frequency_response(const SensorBench::Set& set);

/// Times from a step of 1.5 thresholds to each pixel's first event, µs, sorted; without silent
/// pixels.
struct Latency {
  std::vector<double> delays_us;
  double expected_median_us = 0;
};
Latency latency(SensorBench::Set set);

/// Events under constant light.
struct Noise {
  double rate_hz = 0;  ///< Per pixel.
  double on_share = 0;
  std::vector<double> intervals_s;  ///< Between the events of one pixel, sorted.
};
Noise noise(const SensorBench::Set& set, double seconds);

/// Growth of ln(light) up to the next event, for each pixel, sorted: the cumulative distribution is
/// the S-curve whose width is the mismatch.
std::vector<double> thresholds(SensorBench::Set set);

/// Intervals between events of one pixel under very fast changes of light, µs, sorted.
std::vector<double> refractory_intervals(const SensorBench::Set& set);

/// Output rate of the sensor against the event rate of its pixels.
struct Saturation {
  Curve output_mev_s;  ///< x: made, Mev/s.
  Curve lost_share;
  /// After simultaneous events of all pixels: share of them read out, over µs since the first.
  Curve burst;
};
Saturation saturation(SensorBench::Set set);

/// The sum of signed events times threshold, and ln(light), both from 0: x in s. A pixel with
/// different ON and OFF thresholds drifts with every cycle of the light; the drifts of all pixels
/// cancel out.
struct Conservation {
  Curve light;
  Curve sum;  ///< Mean over the pixels.
  /// For each pixel after the light has settled, in thresholds, sorted.
  std::vector<double> differences;
};
Conservation conservation(const SensorBench::Set& set);

}  // namespace puck
