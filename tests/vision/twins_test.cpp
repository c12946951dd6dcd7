#include "common/vision/twins.h"

#include <cstdint>

#include <doctest/doctest.h>

#include "common/vision/track_trust.h"
#include "tests/vision/contour_world.h"

namespace puck {
namespace {

using test::kContext;

const ContourTrack kMainTrack(kContext, {.position = {300, 200}, .velocity = {900, 100}}, 0, 0);

TEST_CASE("A twin at rest is born where the main track is, each 2 ms") {
  Twins twins;
  Challengers challengers;
  twins.bear_at_rest(kMainTrack, kContext, 1'999, challengers);
  CHECK(test::count(challengers) == 0);
  twins.bear_at_rest(kMainTrack, kContext, 2'000, challengers);
  twins.bear_at_rest(kMainTrack, kContext, 3'999, challengers);
  REQUIRE(test::count(challengers) == 1);
  CHECK(challengers.begin()->kind() == Challenger::Kind::kTwin);
  CHECK(challengers.begin()->track().filter().position() == Pixel{300, 200});
  CHECK(challengers.begin()->track().filter().speed_px_s() == 0);
  twins.bear_at_rest(kMainTrack, kContext, 4'000, challengers);
  CHECK(test::count(challengers) == 2);
}

TEST_CASE("No twin at rest is born of a track beyond doubt while it explains its events") {
  ContourContext trusted = kContext;
  trusted.is_trusted = true;
  test::MovingContour puck(trusted.contour, {250, 180}, {700, 300});
  ContourTrack sound(trusted, {.position = {250, 180}}, 0, 0);
  test::follow(sound, puck, trusted, 0, 60'000);
  REQUIRE(sound.quality() > TrackTrust::kSound);

  // Of a track with so many events, worth so much each, besides as many that said nothing; `age_us`
  // after the decision that followed them.
  const auto is_born = [](const ContourTrack& main, const ContourContext& context, int events,
                          double worth, std::int64_t age_us = 500) {
    Twins twins;
    Challengers challengers;
    twins.bear_at_rest(main, context, 1'000, challengers);
    for (int i = 0; i < events; ++i) {
      twins.take(worth);
      twins.take(0);
    }
    twins.bear_at_rest(main, context, 2'000, challengers);
    twins.bear_at_rest(main, context, 2'000 + age_us, challengers);
    return test::count(challengers) > 0;
  };
  CHECK_FALSE(is_born(sound, trusted, 200, 1));
  CHECK(is_born(sound, trusted, 200, 0.8));
  CHECK(is_born(sound, trusted, 200, -1));
  CHECK(is_born(sound, trusted, 20, 1));
  CHECK(is_born(sound, trusted, 200, 1, 5'000));
  CHECK(is_born(sound, kContext, 200, 1));
  CHECK(is_born(kMainTrack, trusted, 200, 1));
}

TEST_CASE("The other opinion on the wall puts the centre elsewhere, at the same velocity") {
  Twins twins;
  Challengers challengers;
  twins.bear_of_other_wall(kMainTrack, kContext, 59'999, challengers);
  CHECK(test::count(challengers) == 0);
  twins.bear_of_other_wall(kMainTrack, kContext, 60'000, challengers);
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
  twins.bear_at_rest(kMainTrack, none, 100'000, challengers);
  twins.bear_of_other_wall(kMainTrack, none, 100'000, challengers);
  CHECK(test::count(challengers) == 0);
}

}  // namespace
}  // namespace puck
