#include "common/vision/track_standing.h"

#include "common/vision/image_bounds.h"

namespace puck {
namespace {

constexpr double kResting_px_s = 60;
constexpr double kSupportedQuality = 0.1;
constexpr double kSupportedStrength = 15;
constexpr double kSupportedShare = 0.5;
// A puck that comes to rest against a mallet looks bad before both fall silent, so soon and so near
// that it can be no other.
constexpr double kHeldCover = 0.45;
constexpr std::int64_t kComesToRestFor_us = 150'000;
constexpr double kComesToRestWithin_px = 8;
// A puck whose centre has been outside the image for so long, unseen, has left.
constexpr std::int64_t kLeaving_us = 10'000;

}  // namespace

void TrackStanding::judge(const TrackLooks& main, bool witness_is_near, bool head_turns,
                          const TrackTrust& trust, std::int64_t time_us) {
  const bool in_image = is_in_image(main.position, sensor_);
  is_resting_ = main.is_quiet() && !head_turns && trust.may_rest() &&
                main.speed_px_s < kResting_px_s && witness_is_near;
  if (!is_resting_) moved_us_ = time_us;
  // Beside a hand or a mallet the track looks poor. That the blob agrees, and that the ring still
  // has more events than its surroundings explain, says that it is right all the same.
  const bool may_be_right =
      trust.is_trusted() && witness_is_near && main.strength > kSupportedStrength;
  const bool is_supported = may_be_right && main.quality > kSupportedQuality;
  const bool stays = time_us - whole_us_ < kComesToRestFor_us &&
                     distance_px(whole_at_, main.position) < kComesToRestWithin_px;
  const bool is_caught =
      may_be_right && stays && main.strength > kSupportedShare * main.near_events;
  const bool came_to_rest = is_resting_ && trust.is_surely_puck() && stays;
  if (in_image && trust.is_believed() &&
      (main.is_good() || is_supported || is_caught || came_to_rest ||
       (is_resting_ && state_ == TrackState::kTracking))) {
    held_us_ = time_us;
    // What is held as caught does not become whole by it.
    if (is_resting_ || (main.cover > kHeldCover && (main.is_good() || is_supported))) {
      whole_us_ = time_us;
      whole_at_ = main.position;
    }
  }
  if (time_us - held_us_ <= (in_image ? coast_us_ : kLeaving_us)) {
    state_ = TrackState::kTracking;
    if (in_image) left_image_.reset();
    return;
  }
  if (!in_image && !left_image_) left_image_ = nearest_in_image(main.position, sensor_);
  state_ = TrackState::kLost;
}

}  // namespace puck
