#include "common/vision/way_back.h"

#include <algorithm>

namespace puck {
namespace {

// Nearer than this it may be at once: the place where it was last seen is not known better, nor
// when.
constexpr double kAtOnce_px = 60;
// What comes towards the camera gets faster in the image.
constexpr double kFaster = 1.3;
// Something hits most of what is slower than this.
constexpr double kLeast_px_s = 1'000;

}  // namespace

void WayBack::note_left(Pixel edge, double speed_px_s, std::int64_t time_us) {
  left_ = Left{edge, std::max(speed_px_s, kLeast_px_s), time_us};
}

std::optional<WayBack::Reach> WayBack::reach(std::int64_t time_us) const {
  if (!left_) return std::nullopt;
  const double gone_s = static_cast<double>(time_us - left_->time_us) * 1e-6;
  return Reach{left_->edge, kAtOnce_px + kFaster * left_->speed_px_s * gone_s};
}

}  // namespace puck
