#include "common/vision/twins.h"

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

const ContourContext kContext = test::contour_context();
const ContourTrack kMain(kContext, {.position = {300, 200}, .velocity = {900, 100}}, 0, 0);

TEST_CASE("A twin at rest is born where the main track is, each 2 ms") {
  Twins twins;
  Challengers challengers;
  twins.bear_at_rest(kMain, kContext, 1'999, challengers);
  CHECK(test::count(challengers) == 0);
  twins.bear_at_rest(kMain, kContext, 2'000, challengers);
  twins.bear_at_rest(kMain, kContext, 3'999, challengers);
  REQUIRE(test::count(challengers) == 1);
  CHECK(challengers.begin()->kind() == Challenger::Kind::kTwin);
  CHECK(challengers.begin()->track().filter().position() == Pixel{300, 200});
  CHECK(challengers.begin()->track().filter().speed_px_s() == 0);
  twins.bear_at_rest(kMain, kContext, 4'000, challengers);
  CHECK(test::count(challengers) == 2);
}

TEST_CASE("The other opinion on the wall puts the centre elsewhere, at the same velocity") {
  Twins twins;
  Challengers challengers;
  twins.bear_of_other_wall(kMain, kContext, 59'999, challengers);
  CHECK(test::count(challengers) == 0);
  twins.bear_of_other_wall(kMain, kContext, 60'000, challengers);
  REQUIRE(test::count(challengers) == 1);
  const ContourTrack& twin = challengers.begin()->track();
  const double share = kContext.contour.other_wall_share();
  CHECK(twin.wall_share() == share);
  CHECK(twin.filter().velocity().x == 900);
  CHECK(twin.filter().position().y ==
        doctest::Approx(200 + share * kContext.contour.size_at({300, 200}).width / 2));
}

TEST_CASE("Each of the two can be switched off") {
  ContourContext none = kContext;
  none.ingredients.twins = false;
  none.ingredients.wall = false;
  Twins twins;
  Challengers challengers;
  twins.bear_at_rest(kMain, none, 100'000, challengers);
  twins.bear_of_other_wall(kMain, none, 100'000, challengers);
  CHECK(test::count(challengers) == 0);
}

}  // namespace
}  // namespace puck
