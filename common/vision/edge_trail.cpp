#include "common/vision/edge_trail.h"

#include <algorithm>

namespace puck {

void EdgeTrail::learn(double spread_px, double speed_px_s, Timestamp time) {
  if (!params_.enabled) return;
  const double elapsed_ms = static_cast<double>(time - learned_at_) * 1e-3;
  learned_at_ = time;
  const double blur_px = params_.blur_us * 1e-6 * speed_px_s;
  const double length = std::clamp(
      (spread_px - blur_px - params_.short_px) / (params_.long_px - params_.short_px), 0.0, 1.0);
  // After a pause the last millisecond counts no more than another.
  const double share = std::clamp(elapsed_ms, 0.0, 10.0) / params_.learning_ms;
  length_ += std::min(share, 1.0) * (length - length_);
}

}  // namespace puck
