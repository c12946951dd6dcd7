#include "common/vision/settling.h"

#include "common/vision/track_trust.h"

namespace puck {
namespace {

// Enough events to be sure of the place to a few tenths of a pixel.
constexpr double kClearStrength = 20;
constexpr double kClearStrengthOfFaint = 15;
constexpr double kNearlyResting_px_s = 200;
// Few enough that what noise is left may be a part of them that counts.
constexpr double kFewEvents = 12;
// They die away so soon, or the puck creeps on.
constexpr std::int64_t kDyingFor_us = 150'000;
constexpr std::int64_t kDyingOfFaintFor_us = 80'000;
// Noise leads a track no farther in that time.
constexpr double kDrift_px = 12;

}  // namespace

bool Settling::settle(ContourTrack& main, const ContourContext& context, bool was_covered,
                      std::int64_t time_us) {
  // Otherwise it may be a mallet that stops.
  if (!context.ingredients.settling || !context.is_trusted) return false;
  const TrackLooks looks = main.looks();
  const bool is_faint = context.signature.is_faint();
  const double clear_strength = is_faint ? kClearStrengthOfFaint : kClearStrength;
  const double clarity = context.signature.may_be_faint() ? looks.quality : looks.clarity;
  if (clarity > TrackTrust::kSound && looks.strength > clear_strength) {
    place_ = main.last_ring_position();
    was_slow_ = looks.speed_px_s < kNearlyResting_px_s;
    clear_us_ = time_us;
    return false;
  }
  const std::int64_t dying_us = is_faint ? kDyingOfFaintFor_us : kDyingFor_us;
  // A covered puck's events die away while it goes on.
  if (was_covered || !was_slow_ || looks.near_events > kFewEvents ||
      time_us - clear_us_ > dying_us || distance_px(place_, looks.position) > kDrift_px) {
    return false;
  }
  main.stop_at(place_, time_us, context);
  main.park();
  return true;
}

}  // namespace puck
