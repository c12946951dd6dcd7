#include "common/vision/left_behind.h"

#include "common/vision/track_trust.h"

namespace puck {
namespace {

// So long after the puck was undisturbed the track may be bad for a moment only.
constexpr std::int64_t kDisturbedFor_us = 5'000;
constexpr double kBad = 0.7;
// A puck that a hand or a mallet stops never rests undisturbed, so that it is enough if it is this
// slow, in the speeds of what a head's turn moves. But a track that stopped for lack of events
// without being at rest may have lost a fast puck under an arm: what still speaks for it are the
// events from before, so long.
constexpr double kSlow = 0.5;
constexpr double kStopped_px_s = 1;
constexpr std::int64_t kStoppedFor_us = 20'000;
// A hand that comes to the puck has taken it or gone by then. Events that never arrived would leave
// the place unswept for ever.
constexpr std::int64_t kLongest_us = 1'000'000;

// Parts outside the image make no events.
bool is_inside_image(Pixel position, const ContourRing& ring, SensorSize sensor) {
  const double half_width = ring.half_width();
  const double middle_y = position.y - ring.rise;
  return position.x > half_width && position.x < sensor.width - half_width &&
         middle_y > ring.semi_y && middle_y < sensor.height - ring.semi_y;
}

bool is_slow_puck(const TrackLooks& looks) {
  return looks.quality > kBad && looks.is_whole_ring() &&
         looks.speed_px_s < kSlow * looks.turning_px_s;
}

}  // namespace

bool LeftBehind::bring_back(ContourTrack& main, const Situation& now, const ContourContext& context,
                            std::int64_t time_us) {
  // A faint puck may leave unseen.
  if (!context.ingredients.left_behind || context.signature.is_faint()) {
    forget();
    return false;
  }
  const TrackLooks looks = main.looks();
  if (looks.speed_px_s < kStopped_px_s) stopped_us_ = time_us;
  const bool is_slow = is_slow_puck(looks) && time_us - stopped_us_ > kStoppedFor_us;
  if (now.is_sure && (now.is_resting || is_slow)) {
    const ContourRing ring = context.contour.ring_at(looks.position, main.wall_share());
    if (is_inside_image(looks.position, ring, now.sensor)) {
      place_.put(looks.position, ring);
    } else {
      place_.forget();
    }
    undisturbed_us_ = time_us;
    is_there_ = false;
    return false;
  }
  const double density = context.signature.last_density();
  is_there_ = looks.quality < TrackTrust::kSound && time_us - undisturbed_us_ < kLongest_us &&
              place_.must_hold_puck(density);
  if (!is_there_) {
    place_.forget();
    return false;
  }
  if (time_us - undisturbed_us_ < kDisturbedFor_us || looks.quality > kBad ||
      !place_.must_hold_puck(density, looks.position)) {
    return false;
  }
  main.stop_at(place_.position(), time_us, context);
  main.park();
  return true;
}

void LeftBehind::forget() {
  place_.forget();
  is_there_ = false;
}

}  // namespace puck
