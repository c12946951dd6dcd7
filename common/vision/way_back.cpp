#include "common/vision/way_back.h"

namespace puck {
namespace {

// Nearer than this it may be at once: where it left, and when, is not known better.
constexpr double kAtOnce_px = 60;
// What has gone away from the camera since, or bounced, has been at most so much faster.
constexpr double kSlowedDown = 2;

}  // namespace

bool WayBack::Reach::may_lead_to(Pixel place, double speed_px_s) const {
  return distance_px(from, place) <= kAtOnce_px + kSlowedDown * speed_px_s * gone_s;
}

std::optional<WayBack::Reach> WayBack::reach(std::int64_t time_us) const {
  if (!left_) return std::nullopt;
  return Reach{left_->place, static_cast<double>(time_us - left_->time_us) * 1e-6};
}

}  // namespace puck
