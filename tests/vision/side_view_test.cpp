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

TEST_CASE("a puck that was at a side may be there for 0.3 s more") {
  SideWatch watch(test::kSensor);
  CHECK_FALSE(watch.may_be_aside(0));
  watch.note(Pixel{526, 240}, 1'000);
  CHECK_FALSE(watch.may_be_aside(1'000));
  watch.note(Pixel{530, 240}, 2'000);
  CHECK(watch.may_be_aside(2'000));
  // Where it is by now is not known, or is in the middle.
  watch.note(std::nullopt, 3'000);
  watch.note(Pixel{320, 240}, 200'000);
  CHECK(watch.may_be_aside(301'000));
  CHECK_FALSE(watch.may_be_aside(302'000));
}

TEST_CASE("a puck that has left the image to a side is awaited there for as long as it is away") {
  SideWatch watch(test::kSensor);
  for (std::int64_t us = 0; us < 2'000'000; us += 1'000) watch.note(Pixel{0, 100}, us);
  CHECK(watch.may_be_aside(2'000'000));
  watch.note(Pixel{639, 100}, 3'000'000);
  CHECK(watch.may_be_aside(3'000'000));
}

TEST_CASE("an image of a single column has no sides that matter") {
  const SideView view = side_view_of(kRing, {0, 0}, {1, 480});
  CHECK(view.slack_px == 0);
  CHECK(view.sectors == kContourSectors / 2);
}

}  // namespace puck
