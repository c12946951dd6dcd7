#include "common/vision/scene_rest.h"

namespace puck {
namespace {

// What moves with the scene for so long lies there, or nearly so: a filter knows its velocity no
// better.
constexpr std::int64_t kLiesAfter_us = 10'000;
constexpr double kWithScene_px_s = 90;
constexpr double kClearQuality = 0.6;
// A good track so far from there has been set off.
constexpr double kSetOff_px = 5;
// A puck that is not seen again for so long may be anywhere.
constexpr std::int64_t kLongestUnseen_us = 500'000;

bool may_be_held(const ContourContext& context) {
  return context.ingredients.scene_rests && !context.signature.knows_multiplicity() &&
         !context.is_trusted;
}

}  // namespace

void SceneRest::hold(ContourTrack& main, const Background& background,
                     const ContourContext& context, std::int64_t time_us) {
  if (!may_be_held(context)) {
    forget();
  } else if (main.is_good() && main.quality() > kClearQuality) {
    watch(main, background, time_us);
  } else {
    follows_since_us_.reset();
    carry(main, background, context, time_us);
  }
}

void SceneRest::watch(const ContourTrack& main, const Background& background,
                      std::int64_t time_us) {
  const TrackLooks looks = main.looks();
  if (lies_at_) {
    const auto place = background.place_of(*lies_at_);
    if (!place || distance_px(*place, looks.position) > kSetOff_px) forget();
  }
  const auto own_px_s = background.own_speed_px_s(looks.position, main.filter().velocity());
  if (!own_px_s || *own_px_s > kWithScene_px_s || !looks.has_pucks_size()) {
    follows_since_us_.reset();
    return;
  }
  if (!follows_since_us_) follows_since_us_ = time_us;
  if (time_us - *follows_since_us_ < kLiesAfter_us) return;
  lies_at_ = background.scene_place_of(looks.position);
  seen_us_ = time_us;
}

void SceneRest::carry(ContourTrack& main, const Background& background,
                      const ContourContext& context, std::int64_t time_us) {
  if (!lies_at_) return;
  const auto place = background.place_of(*lies_at_);
  if (!place || time_us - seen_us_ > kLongestUnseen_us) {
    forget();
    return;
  }
  main.carry_to(*place, background.still_velocity_at(*place).value_or(PixelVelocity{}), context);
}

}  // namespace puck
