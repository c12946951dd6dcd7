#include "common/play/hit_finder.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

// Interval long enough for a soft hit to show in a filtered track.
constexpr std::int64_t kStepUs = 60'000;
// After a longer gap the puck counts as seen for the first time.
constexpr std::int64_t kForgottenUs = 400'000;
// Smallest change of velocity that is a hit, added to kSigmas of the track's uncertainty.
constexpr double kChangeMS = 0.2;
constexpr double kSigmas = 3;
// Uncertainty of the time of a bounce.
constexpr double kBounceTimeS = 0.006;
// A new puck that moves away from an end nearer than this was served there or bounced.
constexpr double kBesideEndM = 0.2;

// Nearer to a rail, a bounce may be incomplete in the track.
constexpr double kNearRailM = 0.015;
// A puck expected in a goal may still be seen this near to it.
constexpr double kNearGoalM = 0.1;

}  // namespace

bool HitFinder::moves_by_a_hit(const PuckTrack& track) const {
  const auto& [position, velocity] = track.state;
  if (std::hypot(velocity.x_m_s, velocity.y_m_s) < kChangeMS) return false;
  const double from_end_m =
      velocity.x_m_s < 0 ? motion_.table().length_m - position.x_m : position.x_m;
  return from_end_m > kBesideEndM;
}

// Difference of the puck's velocity from that of a gliding puck; nothing if not significant.
std::optional<TableVelocity> HitFinder::change_since(const PuckTrack& track,
                                                     double elapsed_s) const {
  const PuckMotion::Advanced expected = motion_.advance(older_->track, elapsed_s);
  const PuckState& was = expected.track.state;
  const PuckState& is = track.state;
  const TableVelocity change{is.velocity.x_m_s - was.velocity.x_m_s,
                             is.velocity.y_m_s - was.velocity.y_m_s};
  if (expected.in_goal) {
    const double off_m =
        std::hypot(is.position.x_m - was.position.x_m, is.position.y_m - was.position.y_m);
    if (off_m < kNearGoalM) return std::nullopt;
    return change;
  }
  const double variance = largest_speed_variance(expected.track) + largest_speed_variance(track);
  if (std::hypot(change.x_m_s, change.y_m_s) <= kChangeMS + kSigmas * std::sqrt(variance)) {
    return std::nullopt;
  }
  return change;
}

bool HitFinder::is_at_rail(const TablePoint& at) const {
  const TableGeometry& table = motion_.table();
  const double near_m = table.puck_radius_m + kNearRailM;
  return at.x_m < near_m || at.x_m > table.length_m - near_m ||
         std::abs(at.y_m) > table.width_m / 2 - near_m;
}

std::optional<TableVelocity> HitFinder::see(Timestamp t, const PuckTrack& track) {
  if (!older_ || t - newer_.t > kForgottenUs) {
    older_ = newer_ = {t, track};
    if (!moves_by_a_hit(track)) return std::nullopt;
    return track.state.velocity;
  }
  if (is_at_rail(track.state.position)) return std::nullopt;
  const double elapsed_s = static_cast<double>(t - older_->t) * 1e-6;
  const std::optional<TableVelocity> change = change_since(track, elapsed_s);
  if (change && change_since(track, std::max(0.0, elapsed_s - kBounceTimeS)) &&
      change_since(track, elapsed_s + kBounceTimeS)) {
    older_ = newer_ = {t, track};
    return change;
  }
  if (t - newer_.t >= kStepUs) {
    older_ = newer_;
    newer_ = {t, track};
  }
  return std::nullopt;
}

}  // namespace puck
