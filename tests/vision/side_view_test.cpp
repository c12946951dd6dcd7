#include "common/vision/side_view.h"

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

const ContourRing kRing{16, 10, 0, 0};

SideView view_at(double x, double y) { return side_view_of(kRing, {x, y}, test::kSensor); }

}  // namespace

TEST_CASE("in the image's middle a puck's size is as calibrated, at its sides it may be another") {
  CHECK(view_at(320, 240).slack_px == 0);
  CHECK(view_at(500, 240).slack_px == 0);
  CHECK(view_at(620, 240).slack_px == doctest::Approx(0.08 * 16));
  CHECK(view_at(552, 240).slack_px > 0);
  CHECK(view_at(552, 240).slack_px < view_at(560, 240).slack_px);
}

TEST_CASE("both sides of the image are alike, and larger pucks have more slack") {
  CHECK(view_at(20, 240).slack_px == doctest::Approx(view_at(619, 240).slack_px));
  CHECK(side_view_of({32, 20, 0, 0}, {620, 240}, test::kSensor).slack_px ==
        doctest::Approx(2 * view_at(620, 240).slack_px));
}

TEST_CASE("a ring in the image is seen in all directions, one on its border in half of them") {
  CHECK(view_at(320, 240).sectors == kContourSectors);
  CHECK(view_at(622, 240).sectors == kContourSectors);
  CHECK(view_at(639, 240).sectors == kContourSectors / 2);
  CHECK(view_at(0, 240).sectors == kContourSectors / 2);
  CHECK(view_at(320, 0).sectors == kContourSectors / 2);
  const int cut = view_at(630, 240).sectors;
  CHECK(cut > kContourSectors / 2);
  CHECK(cut < kContourSectors);
}

TEST_CASE("a corner of a ring is not taken for one") {
  CHECK(view_at(0, 0).sectors == kContourSectors / 2);
  CHECK(view_at(700, 240).sectors == kContourSectors / 2);
}

TEST_CASE("a ring that lies above the puck's centre is cut where it lies") {
  const ContourRing raised{16, 10, 0, 8};
  CHECK(side_view_of(raised, {320, 15}, test::kSensor).sectors < kContourSectors);
  CHECK(side_view_of(raised, {320, 475}, test::kSensor).sectors == kContourSectors);
}

}  // namespace puck
