#include "common/vision/contour/side_view.h"

#include <algorithm>
#include <cmath>

namespace puck {
namespace {

// Where the image's sides begin, and from where on the slack is at its most, in shares of the way
// from the image's middle to its border; and how much that is, in half the puck's widths. Chosen on
// development games in which the head turns by up to 15°; others from there to a step at 0.7 and to
// a tenth were as good.
constexpr double kSidesFrom = 0.65;
constexpr double kSidesTo = 0.8;
constexpr double kMostSlack = 0.08;

double aside(Pixel place, SensorSize sensor) {
  const double half_image = (sensor.width - 1) / 2.0;
  return std::abs(place.x - half_image) / std::max(half_image, 1.0);
}

}  // namespace

double side_slack_px(const ContourRing& ring, Pixel centre, SensorSize sensor) {
  const double share =
      std::clamp((aside(centre, sensor) - kSidesFrom) / (kSidesTo - kSidesFrom), 0.0, 1.0);
  return share * kMostSlack * ring.drawn_out_semi_x();
}

}  // namespace puck
