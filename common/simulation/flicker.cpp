#include "common/simulation/flicker.h"

#include <cmath>
#include <numbers>

namespace puck {
namespace {

constexpr int kSteps = 1024;  // Samples of one period.

}  // namespace

Flicker::Flicker(double modulation, double frequency_hz, double cutoff_hz)
    : modulation_(modulation), period_us_(1e6 / frequency_hz) {
  if (is_off()) return;
  const double turn = 2 * std::numbers::pi;
  const double decay = std::exp(-turn * cutoff_hz / (frequency_hz * kSteps));
  const auto light_at = [&](int step) {
    return std::log1p(modulation * std::sin(turn * step / kSteps));
  };
  // The low-pass is linear: the response after one period from level 0 gives the start level of the
  // periodic steady state.
  double response = 0;
  const auto advance = [&](int step) {
    const double light = (light_at(step) + light_at(step + 1)) / 2;
    response = light + (response - light) * decay;
  };
  for (int step = 0; step < kSteps; ++step) advance(step);
  response /= 1 - std::pow(decay, kSteps);
  for (int step = 0; step <= kSteps; ++step) {
    response_.push_back(static_cast<float>(response));
    advance(step);
  }
}

float Flicker::interpolated(double time_us) const {
  const double periods = time_us / period_us_;
  const double place = (periods - std::floor(periods)) * kSteps;
  const auto step = static_cast<std::size_t>(place);
  const float share = static_cast<float>(place - static_cast<double>(step));
  if (step >= kSteps) return response_.back();
  return response_[step] + share * (response_[step + 1] - response_[step]);
}

}  // namespace puck
