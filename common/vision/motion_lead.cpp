#include "common/vision/motion_lead.h"

#include <cmath>

namespace puck {

Pixel led(Pixel position, PixelVelocity velocity, double lag_us, const MotionLeadParams& params) {
  if (!params.enabled) return position;
  const double speed = std::hypot(velocity.x, velocity.y);
  const double lead_s =
      (lag_us + params.edge_us) * 1e-6 + params.edge_px / std::hypot(speed, params.slow_px_s);
  return {position.x + lead_s * velocity.x, position.y + lead_s * velocity.y};
}

}  // namespace puck
