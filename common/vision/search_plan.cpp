#include "common/vision/search_plan.h"

#include <algorithm>

#include "common/vision/track_trust.h"

namespace puck {
namespace {

constexpr std::int64_t kFirstPeriod_us = 10'000;
// After this time a lost puck may be anywhere, and a track without a good score may be another
// object: the whole image is searched more often, and the track's neighbourhood no more.
constexpr std::int64_t kAnywhereAfter_us = 100'000;
constexpr std::int64_t kAnywherePeriod_us = 5'000;
constexpr std::int64_t kNearPeriod_us = 5'000;
constexpr std::int64_t kWidePeriod_us = 40'000;
// For a sound and proven track the whole image is searched rarely.
constexpr std::int64_t kCalmPeriod_us = 500'000;
constexpr std::int64_t kRestingPeriod_us = 1'000'000;
// A faint puck may have moved away unseen, a covered one may be gone, and an object that never
// moved may be no puck; but a departure makes events at the place of rest.
constexpr std::int64_t kMaybeRestingPeriod_us = 50'000;
// Without motion no candidate could be confirmed by events.
constexpr std::int64_t kStillPeriod_us = 1'000'000;

constexpr double kDoubtful = 0.6;
// No other puck could be three times as strong as this. A round mark under a turning head could, so
// the track must have moved as a puck does.
constexpr double kLively = 300;

constexpr double kRadius_px = 20;
constexpr double kGrowth_px_us = 1.5e-3;
constexpr double kLargestRadius_px = 200;

}  // namespace

SearchPlan::SearchPlan(SensorSize sensor, const Region& detection_region)
    : image_(Region::all_of(sensor)),
      detection_region_(detection_region.empty() ? image_ : detection_region.intersect(image_)),
      stirrings_(sensor) {}

bool SearchPlan::may_be_anywhere(const Situation& now) {
  if (now.is_lost) return now.since_good_us > kAnywhereAfter_us;
  return !now.is_resting && !now.may_be_faint && now.unsound_us > kAnywhereAfter_us;
}

std::int64_t SearchPlan::usual_period_us(const Situation& now, bool is_still) {
  if (now.is_lost) return kFirstPeriod_us;
  if (now.is_resting) {
    return now.may_rest_elsewhere && !is_still ? kMaybeRestingPeriod_us : kRestingPeriod_us;
  }
  if (now.main.quality < TrackTrust::kSound || !now.is_trusted || !now.is_proven) {
    return kWidePeriod_us;
  }
  return now.main.strength > kLively ? kNever_us : kCalmPeriod_us;
}

void SearchPlan::plan_first(std::int64_t time_us) {
  stirrings_.judge(time_us);
  if (is_busy() || time_us < next_us_ || is_pointless(time_us)) return;
  next_us_ = time_us + kFirstPeriod_us;
  if (since_us_ < 0) since_us_ = time_us;
  want(detection_region_, time_us);
}

void SearchPlan::plan(const Situation& now, const ContourIngredients& ingredients,
                      std::int64_t time_us) {
  stirrings_.judge(time_us);
  const bool anywhere = ingredients.anywhere && ingredients.wide_search && may_be_anywhere(now);
  if (is_busy() || ((now.is_lost || anywhere) && is_pointless(time_us))) return;
  const std::int64_t wide_period_us =
      anywhere ? kAnywherePeriod_us : usual_period_us(now, is_still(time_us));
  if (ingredients.wide_search && time_us - wide_us_ >= wide_period_us) {
    wide_us_ = time_us;
    want(image_, time_us);
    return;
  }
  if (ingredients.search && !now.is_resting && !anywhere && now.main.quality < kDoubtful &&
      time_us >= next_us_) {
    next_us_ = time_us + kNearPeriod_us;
    const double radius_px = std::min(
        kLargestRadius_px, kRadius_px + kGrowth_px_us * static_cast<double>(now.since_good_us));
    const int side = 2 * static_cast<int>(radius_px) + 1;
    want(Region::around(now.main.position, side, side).intersect(image_), time_us);
  }
}

bool SearchPlan::is_pointless(std::int64_t time_us) const {
  return is_still(time_us) && time_us - wanted_us_ < kStillPeriod_us;
}

void SearchPlan::want(const Region& region, std::int64_t time_us) {
  wanted_ = region;
  wanted_us_ = time_us;
}

Region SearchPlan::give_out() {
  const Region given = wanted_;
  if (!given.empty()) out_ = given;
  wanted_ = {};
  return given;
}

}  // namespace puck
