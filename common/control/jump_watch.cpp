#include "common/control/jump_watch.h"

#include <algorithm>
#include <cmath>

namespace puck {

void JumpWatch::see(const TablePoint& place, std::int64_t sensor_us, std::int64_t monotonic_us) {
  if (last_) {
    // As doubles, since the sensor's time may have any value. After 1 s any place is possible.
    const double s = std::clamp(
        1e-6 * (static_cast<double>(sensor_us) - static_cast<double>(last_->sensor_us)), 0.0, 1.0);
    const double moved_m = std::hypot(place.x_m - last_->place.x_m, place.y_m - last_->place.y_m);
    if (moved_m > params_.noise_m + params_.max_speed_m_s * s) {
      ++jumps_;
      jumped_us_ = monotonic_us;
    }
  }
  last_ = Seen{place, sensor_us};
}

}  // namespace puck
