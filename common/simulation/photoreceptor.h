#pragma once

#include <algorithm>
#include <cmath>

namespace puck {

/// A photoreceptor's output while ln(intensity) changes linearly from one level to another: the
/// exact response of a first-order low-pass, plus the flicker, interpolated linearly between its
/// two ends.
struct PhotoreceptorRamp {
  double duration_us = 0;
  double time_constant_us = 0;
  float response = 0;  ///< At the start, without the flicker.
  float light_before = 0;
  float light_after = 0;
  float flicker_before = 0;
  float flicker_after = 0;

  double slope() const { return (light_after - light_before) / duration_us; }
  double lag() const { return slope() * time_constant_us; }
  /// Transient part of the response: its excess over the steady response to this ramp.
  double excess() const { return response - light_before + lag(); }

  /// Response at the end, without the flicker; `decay`: exp(-duration / time constant).
  float response_after(double decay) const {
    return static_cast<float>(light_after - lag() + excess() * decay);
  }
  /// Time from the start, in µs, at which the output crosses a level between its two ends.
  double crossing_us(float level, float output_before, float output_after) const {
    // Newton's method, started on the straight line between the ends.
    constexpr int kIterations = 3;
    const double flicker_slope = (flicker_after - flicker_before) / duration_us;
    double t_us = duration_us * (level - output_before) / (output_after - output_before);
    for (int i = 0; i < kIterations; ++i) {
      const double decayed = excess() * std::exp(-t_us / time_constant_us);
      const double now = light_before - lag() + slope() * t_us + decayed;
      const double flicker = flicker_before + flicker_slope * t_us;
      const double rate = slope() + flicker_slope - decayed / time_constant_us;
      const double step_us = (now + flicker - level) / rate;
      if (!(std::abs(step_us) < duration_us)) break;
      t_us = std::clamp(t_us - step_us, 0.0, duration_us);
    }
    return t_us;
  }
};

}  // namespace puck
