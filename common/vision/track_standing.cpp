#include "common/vision/track_standing.h"

#include <algorithm>

namespace puck {
namespace {

constexpr double kSlow_px_s = 60;
constexpr double kSupportedQuality = 0.1;
constexpr double kSupportedStrength = 15;
// A puck whose centre has been outside the image for so long, unseen, has left.
constexpr std::int64_t kLeaving_us = 10'000;

}  // namespace

void TrackStanding::judge(const TrackLooks& main, bool witness_agrees, bool head_turns,
                          const TrackTrust& trust, std::int64_t time_us) {
  const Pixel nearest_in_image{std::clamp(main.position.x, 0.0, sensor_.width - 1.0),
                               std::clamp(main.position.y, 0.0, sensor_.height - 1.0)};
  const bool in_image = main.position == nearest_in_image;
  is_resting_ = main.is_quiet() && !head_turns && trust.may_rest() &&
                main.speed_px_s < kSlow_px_s && witness_agrees;
  if (!is_resting_) moved_us_ = time_us;
  // Beside a hand or a mallet the track looks poor. That the blob agrees, and that the ring still
  // has more events than its surroundings explain, says that it is right all the same.
  const bool is_supported = trust.is_trusted() && witness_agrees &&
                            main.quality > kSupportedQuality && main.strength > kSupportedStrength;
  if (in_image && trust.is_believed() &&
      (main.is_good() || is_supported || (is_resting_ && state_ == TrackState::kTracking))) {
    held_us_ = time_us;
    left_image_.reset();
  }
  if (time_us - held_us_ <= (in_image ? coast_us_ : kLeaving_us)) {
    state_ = TrackState::kTracking;
    return;
  }
  if (!in_image && !left_image_) left_image_ = nearest_in_image;
  state_ = TrackState::kLost;
}

}  // namespace puck
