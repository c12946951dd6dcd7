#pragma once

#include <string>
#include <vector>

#include "tools/simulate/sensor_bench.h"

namespace puck {

/// The measurements by which the field characterises event cameras, taken on the simulated one.
/// Each returns what was measured and, where theory has an answer, what is expected.
struct Curve {
  struct Point {
    double x = 0;
    double y = 0;
  };
  std::string name;
  std::vector<Point> points;
};

/// How many of the pixels answer a step of the light with 0, 1, 2 … events.
struct StepResponse {
  Curve measured;  ///< x: events, y: share of the pixels.
  Curve expected;
};
StepResponse step_response(const SensorBench::Set& set, double log_ratio);

/// Events per pixel and cycle against the swing of ln(light), far below the cutoff.
Curve contrast_response(const SensorBench::Set& set);

/// Events per cycle against frequency, as a share of those far below the cutoff: x in Hz.
struct FrequencyResponse {
  Curve measured;
  Curve expected;  ///< Of a first-order low-pass.
  double corner_hz = 0;
};
FrequencyResponse frequency_response(const SensorBench::Set& set);

/// Times from a step of 1.5 thresholds to each pixel's first event, µs, sorted; only of pixels that
/// had one.
struct Latency {
  std::vector<double> delays_us;
  double expected_median_us = 0;
};
Latency latency(SensorBench::Set set);

/// Events of an unchanged light.
struct Noise {
  double rate_hz = 0;  ///< Per pixel.
  double on_share = 0;
  std::vector<double> intervals_s;  ///< Between the events of one pixel, sorted.
};
Noise noise(const SensorBench::Set& set, double seconds);

/// By how much ln(light) must grow for the next event, of each pixel, sorted: as a cumulative
/// distribution it is the S-curve whose width is the mismatch.
std::vector<double> thresholds(SensorBench::Set set);

/// Intervals between the events of one pixel in a light that changes much too fast, µs, sorted.
std::vector<double> refractory_intervals(const SensorBench::Set& set);

/// What leaves the sensor against what its pixels make.
struct Saturation {
  Curve output_mev_s;  ///< x: made, Mev/s.
  Curve lost_share;
  /// When all pixels fire at once: share of them that have left, over µs since the first.
  Curve burst;
};
Saturation saturation(SensorBench::Set set);

/// The sum of signed events times threshold beside ln(light), both from 0: x in s. A pixel whose ON
/// and OFF thresholds differ drifts with every cycle of the light; those of all pixels cancel out.
struct Conservation {
  Curve light;
  Curve sum;  ///< Mean of the pixels.
  /// Of each pixel when the light has come to rest, in thresholds, sorted.
  std::vector<double> differences;
};
Conservation conservation(const SensorBench::Set& set);

}  // namespace puck
