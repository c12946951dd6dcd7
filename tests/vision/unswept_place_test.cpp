#include "common/vision/unswept_place.h"

#include <array>

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

// A place whose ring lies high above its puck, and leans. At one event a px² each quarter of what
// counts of its disc, 0.64 of it, is to make 40.2 events.
class LeaningPlace {
 public:
  LeaningPlace() { put(); }
  void put() { place.put(kPlace, kRing); }

  // Shows so many events at a point of the disc.
  void show(double u, double v, int events) {
    const double dy = v * kRing.semi_y;
    for (int i = 0; i < events; ++i) {
      place.take(kPlace.x + u * kRing.semi_x + kRing.shear * dy, kPlace.y - kRing.rise + dy);
    }
  }
  // … in the middle of each of the first so many of left, right, top and bottom.
  void show_parts(int parts, int events) {
    constexpr std::array<std::array<double, 2>, 4> kMiddles{
        {{-0.5, 0}, {0.5, 0}, {0, -0.5}, {0, 0.5}}};
    for (int i = 0; i < parts; ++i) show(kMiddles.at(i)[0], kMiddles.at(i)[1], events);
  }

  bool holds() const { return place.must_hold_puck(1); }
  // If the puck's centre is at this point of the disc now.
  bool holds_with_puck_at(double u, double v) const {
    const double dy = v * kRing.semi_y;
    return place.must_hold_puck(1, {kPlace.x + u * kRing.semi_x + kRing.shear * dy, kPlace.y + dy});
  }

  static constexpr ContourRing kRing{.semi_x = 10, .semi_y = 8, .shear = 0.5, .rise = 6};
  UnsweptPlace place;
};

TEST_CASE("A part is swept once it has made a fifth of the events that an edge would have made") {
  LeaningPlace place;
  place.show_parts(4, 8);
  CHECK(place.holds());
  place.show_parts(4, 1);
  CHECK_FALSE(place.holds());
  place.put();
  CHECK(place.holds());
}

TEST_CASE("A place is swept when less than two fifths of its parts are not") {
  LeaningPlace place;
  place.show_parts(2, 9);
  CHECK(place.holds());
  place.show(0, -0.5, 9);
  CHECK_FALSE(place.holds());
  // One of the three that what has gone down has left is just a third.
  LeaningPlace left;
  left.show_parts(2, 9);
  CHECK_FALSE(left.holds_with_puck_at(0, 1.4));
}

TEST_CASE("A part has been left once the puck's contour is past its middle") {
  const LeaningPlace place;
  CHECK_FALSE(place.holds_with_puck_at(0.49, 0));
  CHECK(place.holds_with_puck_at(0.51, 0));
  CHECK_FALSE(place.holds_with_puck_at(0, -0.49));
  CHECK(place.holds_with_puck_at(0, -0.51));
  // … where it leans as well.
  CHECK_FALSE(place.holds_with_puck_at(0.49, 0.1));
  CHECK(place.holds_with_puck_at(-0.51, 0.1));
}

TEST_CASE("What lies near the contour or beyond it does not count") {
  LeaningPlace place;
  for (const double r : {0.81, 0.95, 1.2}) {
    place.show(-r, 0, 50);
    place.show(r, 0, 50);
    place.show(0, -r, 50);
    place.show(0, r, 50);
  }
  CHECK(place.holds());
  place.show(-0.79, 0, 50);
  place.show(0.79, 0, 50);
  place.show(0, -0.79, 50);
  CHECK_FALSE(place.holds());
}

TEST_CASE("The region follows the ring to where it lies above the puck") {
  const Region region = LeaningPlace().place.region();
  CHECK(region.contains(300, 180 - 6 - 7));
  CHECK(region.contains(300, 180 - 6 + 7));
  CHECK_FALSE(region.contains(300, 180 + 6));
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
