#include "common/vision/unswept_place.h"

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

constexpr double kDensity = 3;  // MovingContour's
constexpr Pixel kPlace{300, 180};
const PuckContour kContour = test::contour_context().contour;

UnsweptPlace place_at(Pixel position) {
  UnsweptPlace place;
  place.put(position, kContour.ring_at(position, 0));
  return place;
}

// The edges of something of the puck's size pass for so long, from a start at this velocity.
void pass(UnsweptPlace& place, Pixel start, PixelVelocity velocity, std::int64_t duration_us) {
  test::MovingContour shape(kContour, start, velocity, kDensity);
  for (const ContourEvent& event : shape.events(0, duration_us)) place.take(event.x, event.y);
}

TEST_CASE("Nothing is known of a place before there is one, nor after it is forgotten") {
  UnsweptPlace place;
  place.take(300, 180);
  CHECK_FALSE(place.must_hold_puck(kDensity));
  CHECK(place.region().empty());
  place = place_at(kPlace);
  CHECK(place.must_hold_puck(kDensity));
  place.forget();
  CHECK_FALSE(place.must_hold_puck(kDensity));
  CHECK_FALSE(place.must_hold_puck(kDensity, {350, 180}));
  CHECK(place.region().empty());
}

TEST_CASE("While it is not known how many events an edge makes, nothing is known of the place") {
  CHECK_FALSE(place_at(kPlace).must_hold_puck(0));
}

TEST_CASE("A puck that leaves sweeps the place, in whatever direction") {
  for (const PixelVelocity velocity :
       {PixelVelocity{2'000, 0}, {-2'000, 0}, {0, 1'500}, {0, -1'500}, {1'500, 1'000}}) {
    CAPTURE(velocity.x);
    CAPTURE(velocity.y);
    UnsweptPlace place = place_at(kPlace);
    pass(place, kPlace, velocity, 30'000);
    CHECK_FALSE(place.must_hold_puck(kDensity));
    CHECK_FALSE(place.must_hold_puck(kDensity,
                                     {kPlace.x + 0.03 * velocity.x, kPlace.y + 0.03 * velocity.y}));
  }
}

TEST_CASE("What passes beside the puck does not sweep its place") {
  UnsweptPlace place = place_at(kPlace);
  const double width = 2 * kContour.ring_at(kPlace, 0).semi_x;
  pass(place, {kPlace.x + width, kPlace.y - 100}, {0, 2'000}, 100'000);
  CHECK(place.must_hold_puck(kDensity));
  CHECK(place.must_hold_puck(kDensity, {kPlace.x + width, kPlace.y}));
}

TEST_CASE("A puck that has only begun to leave has swept what it has left") {
  const double width = 2 * kContour.ring_at(kPlace, 0).semi_x;
  UnsweptPlace place = place_at(kPlace);
  const auto duration_us = static_cast<std::int64_t>(1e6 * 0.45 * width / 1'000);
  pass(place, kPlace, {1'000, 0}, duration_us);
  const Pixel there{kPlace.x + 0.45 * width, kPlace.y};
  CHECK_FALSE(place.must_hold_puck(kDensity, there));
  // Had it gone the other way, the parts on that side would be swept.
  CHECK(place.must_hold_puck(kDensity, {kPlace.x - 0.4 * width, kPlace.y}));
}

TEST_CASE("Of too few events to be expected nothing follows") {
  const double area =
      3.14 * kContour.ring_at(kPlace, 0).semi_x * kContour.ring_at(kPlace, 0).semi_y;
  const UnsweptPlace place = place_at(kPlace);
  // 0.64 of the disc's events must be more than 15.
  CHECK_FALSE(place.must_hold_puck(14 / (0.64 * area)));
  CHECK(place.must_hold_puck(16 / (0.64 * area)));
}

TEST_CASE("The region holds all that counts, and little else") {
  const UnsweptPlace place = place_at(kPlace);
  const ContourRing ring = kContour.ring_at(kPlace, 0);
  const Region region = place.region();
  CHECK(region.contains(300, 180));
  CHECK(region.contains(static_cast<int>(300 + 0.8 * ring.semi_x), 180));
  CHECK(region.contains(300, static_cast<int>(180 + 0.8 * ring.semi_y)));
  CHECK_FALSE(region.contains(static_cast<int>(300 + 2 * ring.semi_x), 180));
}

}  // namespace
}  // namespace puck
