#pragma once

#include <vector>

namespace puck {

/// A flickering lamp's part of the photoreceptors' responses: ln(1 + modulation · sin) through
/// their low-pass, in its periodic steady state. It is the same for every pixel, since the low-pass
/// is linear in ln(intensity).
class Flicker {
 public:
  Flicker(double modulation, double frequency_hz, double cutoff_hz);

  bool is_off() const { return modulation_ == 0; }
  double period_us() const { return period_us_; }
  float response_at(double time_us) const { return is_off() ? 0 : interpolated(time_us); }

 private:
  float interpolated(double time_us) const;

  double modulation_;
  double period_us_;
  std::vector<float> response_;  ///< Over one period; the last sample repeats the first.
};

}  // namespace puck
