#include "common/vision/side_view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace puck {
namespace {

// Where the image's sides begin, and from where on the slack is at its most, in shares of the way
// from the image's middle to its border.
constexpr double kSidesFrom = 0.65;
constexpr double kSidesTo = 0.8;
// 2 ψ tan θ in widths, of a head turned by 6° and what lies 21° aside.
constexpr double kMostSlack = 0.08;

bool is_inside(Pixel place, SensorSize sensor) {
  return place.x >= 0 && place.x <= sensor.width - 1 && place.y >= 0 &&
         place.y <= sensor.height - 1;
}

bool is_whole(const ContourRing& ring, Pixel centre, SensorSize sensor) {
  const double middle_y = centre.y - ring.rise;
  return is_inside({centre.x - ring.half_width(), middle_y - ring.semi_y}, sensor) &&
         is_inside({centre.x + ring.half_width(), middle_y + ring.semi_y}, sensor);
}

int sectors_in_image(const ContourRing& ring, Pixel centre, SensorSize sensor) {
  if (is_whole(ring, centre, sensor)) return kContourSectors;
  int inside = 0;
  for (int sector = 0; sector < kContourSectors; ++sector) {
    const double angle = (sector + 0.5) * 2 * std::numbers::pi / kContourSectors;
    const double y = ring.semi_y * std::sin(angle);
    const double x = ring.semi_x * std::cos(angle) + ring.shear * y;
    if (is_inside({centre.x + x, centre.y - ring.rise + y}, sensor)) ++inside;
  }
  return std::max(inside, kContourSectors / 2);
}

}  // namespace

SideView side_view_of(const ContourRing& ring, Pixel centre, SensorSize sensor) {
  const double half_image = (sensor.width - 1) / 2.0;
  const double aside = std::abs(centre.x - half_image) / half_image;
  const double share = std::clamp((aside - kSidesFrom) / (kSidesTo - kSidesFrom), 0.0, 1.0);
  return {share * kMostSlack * ring.semi_x, sectors_in_image(ring, centre, sensor)};
}

}  // namespace puck
