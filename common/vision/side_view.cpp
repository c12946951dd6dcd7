#include "common/vision/side_view.h"

#include <algorithm>
#include <array>
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

// Of the middle of each direction, an ellipse's axes being 1.
struct Direction {
  double x = 0;
  double y = 0;
};
constexpr double kNear = 0.9659;
constexpr double kEven = 0.7071;
constexpr double kFar = 0.2588;
constexpr std::array<Direction, kContourSectors> kDirections{{{kNear, kFar},
                                                              {kEven, kEven},
                                                              {kFar, kNear},
                                                              {-kNear, kFar},
                                                              {-kEven, kEven},
                                                              {-kFar, kNear},
                                                              {kNear, -kFar},
                                                              {kEven, -kEven},
                                                              {kFar, -kNear},
                                                              {-kNear, -kFar},
                                                              {-kEven, -kEven},
                                                              {-kFar, -kNear}}};

int sectors_in_image(const ContourRing& ring, double centre_x, double right) {
  if (centre_x - ring.half_width() >= 0 && centre_x + ring.half_width() <= right) {
    return kContourSectors;
  }
  const auto is_in_image = [&](const Direction& direction) {
    const double x =
        centre_x + ring.semi_x * direction.x + ring.shear * ring.face_semi_y() * direction.y;
    return x >= 0 && x <= right;
  };
  return std::max(
      static_cast<int>(std::count_if(kDirections.begin(), kDirections.end(), is_in_image)),
      kContourSectors / 2);
}

}  // namespace

SideView side_view_of(const ContourRing& ring, Pixel centre, SensorSize sensor) {
  const double right = sensor.width - 1;
  const double share =
      std::clamp((aside(centre, sensor) - kSidesFrom) / (kSidesTo - kSidesFrom), 0.0, 1.0);
  return {share * kMostSlack * ring.drawn_out_semi_x(), sectors_in_image(ring, centre.x, right)};
}

void SideWatch::note(const std::optional<Pixel>& puck, std::int64_t time_us) {
  constexpr std::int64_t kMemory_us = 300'000;
  if (puck && aside(*puck, sensor_) > kSidesFrom) until_us_ = time_us + kMemory_us;
}

}  // namespace puck
