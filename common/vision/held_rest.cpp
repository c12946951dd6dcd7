#include "common/vision/held_rest.h"

namespace puck {
namespace {

constexpr std::int64_t kLongestDisturbance_us = 100'000;
// A puck that sets off makes events on both sides; a mallet beside it on one.
constexpr double kDepartingStrength = 12;
constexpr double kDepartingCover = 0.25;

}  // namespace

bool may_hold(const TrackStanding& standing, const PuckSignature& signature) {
  return standing.is_resting() && standing.state() == TrackState::kTracking &&
         !signature.is_faint();
}

void HeldRest::hold(ContourTrack& main, const TrackStanding& standing,
                    const ContourContext& context, std::int64_t time_us) {
  if (!context.ingredients.holding) return;
  judge(main.looks(), may_hold(standing, context.signature), time_us);
  if (sets_off_) main.set_off();
}

void HeldRest::judge(const TrackLooks& main, bool is_resting, std::int64_t time_us) {
  sets_off_ = false;
  if (is_resting) {
    keep(time_us);
    return;
  }
  if (!is_held_) return;
  // What is on the puck does not say that it moves.
  sets_off_ =
      !main.is_covered() && main.strength > kDepartingStrength && main.cover > kDepartingCover;
  const bool is_disturbed_for_long = time_us - quiet_us_ > kLongestDisturbance_us;
  if (sets_off_ || main.is_covered() || is_disturbed_for_long) is_held_ = false;
}

}  // namespace puck
