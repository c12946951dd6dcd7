#include "common/table/puck_trail.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr std::int64_t kSpacingUs = 5'000;
constexpr std::int64_t kMaxAgeUs = 60'000;
// Longest time from a hit until the tracker follows the puck again.
constexpr double kMaxHitAgeS = 0.02;
// Largest distance between the paths before and after a hit, m: for a puck at rest, or just
// re-acquired, the tracker may be off by this much.
constexpr double kMaxGapM = 0.04;
// A slower puck seen elsewhere was not hit.
constexpr double kMinSpeedMS = 1.0;

}  // namespace

void PuckTrail::add(Timestamp t, const PuckState& state) {
  const Sample& newest = samples_[(next_ + kSamples - 1) % kSamples];
  if (count_ > 0 && t - newest.t < kSpacingUs) return;
  samples_[next_] = {t, state};
  next_ = (next_ + 1) % kSamples;
  count_ = std::min(count_ + 1, kSamples);
}

bool PuckTrail::leads_to(Timestamp t, const PuckState& state) const {
  if (std::hypot(state.velocity.x_m_s, state.velocity.y_m_s) < kMinSpeedMS) return false;
  const auto leads = [&](const Sample& sample) {
    if (t - sample.t > kMaxAgeUs) return false;
    const double since_s = static_cast<double>(t - sample.t) * 1e-6;
    const auto& [from, before] = sample.state;
    // Position and velocity relative to the puck's path without a hit, extrapolated back to the
    // closest approach of the two paths.
    const double x_m = state.position.x_m - from.x_m - since_s * before.x_m_s;
    const double y_m = state.position.y_m - from.y_m - since_s * before.y_m_s;
    const double vx_m_s = state.velocity.x_m_s - before.x_m_s;
    const double vy_m_s = state.velocity.y_m_s - before.y_m_s;
    const double speed_squared = vx_m_s * vx_m_s + vy_m_s * vy_m_s;
    if (speed_squared == 0) return false;
    const double ago_s = std::clamp((x_m * vx_m_s + y_m * vy_m_s) / speed_squared, 0.0,
                                    std::min(since_s, kMaxHitAgeS));
    return std::hypot(x_m - ago_s * vx_m_s, y_m - ago_s * vy_m_s) <= kMaxGapM;
  };
  return std::any_of(samples_.begin(), samples_.begin() + static_cast<std::ptrdiff_t>(count_),
                     leads);
}

}  // namespace puck
