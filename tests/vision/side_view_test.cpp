#include "common/vision/side_view.h"

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

const ContourRing kRing{16, 10, 0, 0};

SideView view_at(double x, double y) { return side_view_of(kRing, {x, y}, test::kSensor); }

}  // namespace

TEST_CASE("in the image's middle a puck's size is as calibrated, at its sides it may be larger") {
  CHECK(view_at(320, 240).slack_px == 0);
  CHECK(view_at(500, 240).slack_px == 0);
  CHECK(view_at(620, 240).slack_px == doctest::Approx(0.08 * 16));
  CHECK(view_at(552, 240).slack_px > 0);
  CHECK(view_at(552, 240).slack_px < view_at(560, 240).slack_px);
}

TEST_CASE("both sides of the image are alike, and larger pucks have more slack") {
  CHECK(view_at(87, 240).slack_px == doctest::Approx(view_at(552, 240).slack_px));
  CHECK(side_view_of({32, 20, 0, 0}, {620, 240}, test::kSensor).slack_px ==
        doctest::Approx(2 * view_at(620, 240).slack_px));
}

TEST_CASE("a place is aside where pucks may be larger, and beyond the image") {
  CHECK_FALSE(is_aside({320, 0}, test::kSensor));
  CHECK_FALSE(is_aside({526, 240}, test::kSensor));
  CHECK(is_aside({528, 240}, test::kSensor));
  CHECK(is_aside({-15, 240}, test::kSensor));
}

TEST_CASE("a ring that lies beyond a side of the image is seen in the other directions") {
  CHECK(view_at(320, 240).sectors == kContourSectors);
  CHECK(view_at(623, 240).sectors == kContourSectors);
  CHECK(view_at(639, 240).sectors == kContourSectors / 2);
  CHECK(view_at(0, 240).sectors == kContourSectors / 2);
  // Two of twelve directions point within 30° of the border, and two within 60° of it.
  CHECK(view_at(625, 240).sectors == kContourSectors - 2);
  CHECK(view_at(630, 240).sectors == kContourSectors - 4);
}

TEST_CASE("a sheared ring reaches farther to the side") {
  // Its lower half lies farther to the right, its upper half to the left.
  CHECK(view_at(623, 240).sectors == kContourSectors);
  CHECK(side_view_of({16, 10, 0.5, 0}, {623, 240}, test::kSensor).sectors == kContourSectors - 1);
}

TEST_CASE("a corner of a ring is not taken for one") {
  CHECK(view_at(650, 240).sectors == kContourSectors / 2);
  CHECK(view_at(700, 240).sectors == kContourSectors / 2);
}

TEST_CASE("an image of a single column has no sides that matter") {
  const SideView view = side_view_of(kRing, {0, 0}, {1, 480});
  CHECK(view.slack_px == 0);
  CHECK(view.sectors == kContourSectors / 2);
}

}  // namespace puck
