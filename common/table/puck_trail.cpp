#include "common/table/puck_trail.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

constexpr std::int64_t kApartUs = 5'000;
constexpr std::int64_t kForgottenUs = 60'000;
// A tracker finds a puck that was hit again within so long.
constexpr double kNoticedS = 0.02;
// How far apart the two ways may seem where they meet, m: a tracker that sees little of a puck at
// rest, or has just found it again, may be off by so much.
constexpr double kApartM = 0.04;
// A slower one that is seen elsewhere was not hit there.
constexpr double kSlowestMS = 1.0;

}  // namespace

void PuckTrail::add(Timestamp t, const PuckState& state) {
  const Past& newest = pasts_[(next_ + kPasts - 1) % kPasts];
  if (count_ > 0 && t - newest.t < kApartUs) return;
  pasts_[next_] = {t, state};
  next_ = (next_ + 1) % kPasts;
  count_ = std::min(count_ + 1, kPasts);
}

bool PuckTrail::leads_to(Timestamp t, const PuckState& state) const {
  if (std::hypot(state.velocity.x_m_s, state.velocity.y_m_s) < kSlowestMS) return false;
  const auto leads = [&](const Past& past) {
    if (t - past.t > kForgottenUs) return false;
    const double since_s = static_cast<double>(t - past.t) * 1e-6;
    const auto& [from, before] = past.state;
    // How the puck moves from where it would be now, had nobody hit it; back to when they met.
    const double x_m = state.position.x_m - from.x_m - since_s * before.x_m_s;
    const double y_m = state.position.y_m - from.y_m - since_s * before.y_m_s;
    const double vx_m_s = state.velocity.x_m_s - before.x_m_s;
    const double vy_m_s = state.velocity.y_m_s - before.y_m_s;
    const double speed_squared = vx_m_s * vx_m_s + vy_m_s * vy_m_s;
    if (speed_squared == 0) return false;
    const double ago_s = std::clamp((x_m * vx_m_s + y_m * vy_m_s) / speed_squared, 0.0,
                                    std::min(since_s, kNoticedS));
    return std::hypot(x_m - ago_s * vx_m_s, y_m - ago_s * vy_m_s) <= kApartM;
  };
  return std::any_of(pasts_.begin(), pasts_.begin() + static_cast<std::ptrdiff_t>(count_), leads);
}

}  // namespace puck
