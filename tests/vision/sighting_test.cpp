#include "common/vision/sighting.h"

#include <vector>

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"
#include "tests/vision/sighting_walk.h"

namespace puck {
namespace {

using test::kSensor;

constexpr Pixel kTrackPlace{300, 200};

const PuckContour kFlatContour(kSensor, {30, 0, 0, 20, 0, 0}, {0, 0, 0}, true);

std::optional<Pixel> seen(const std::vector<SearchCandidate>& candidates, bool other_wall = false,
                          double wall_share = 0) {
  const auto sighting = sighting_near(kTrackPlace, wall_share,
                                      {{}, {.other_wall = other_wall}, candidates}, kFlatContour);
  if (!sighting) return std::nullopt;
  CHECK(sighting->is_sure);
  CHECK_FALSE(sighting->is_certain);
  return sighting->place;
}

TEST_CASE("Of what a search found near the track it is the one that looks most like the puck") {
  CHECK(seen({{{303, 204}, 0.7}, {{298, 200}, 0.63}, {{330, 200}, 0.9}}) == Pixel{303, 204});
  CHECK(seen({{{298, 200}, 0.63}, {{303, 204}, 0.7}}) == Pixel{303, 204});
}

TEST_CASE("What is far away, or does not look like the puck, is no sighting") {
  CHECK_FALSE(seen({}).has_value());
  CHECK_FALSE(seen({{{310, 200}, 0.9}}).has_value());
  CHECK(seen({{{309.9, 200}, 0.9}}).has_value());
  CHECK_FALSE(seen({{kTrackPlace, 0.62}}).has_value());
  CHECK(seen({{kTrackPlace, 0.63}}).has_value());
}

TEST_CASE("A sighting is where the puck would be by the track's own opinion on the side wall") {
  const double other = kFlatContour.other_wall_share();
  REQUIRE(other > 0.1);
  // The ring that was seen stays in its place.
  const auto place = seen({{kTrackPlace, 0.9}}, true, 0);
  REQUIRE(place.has_value());
  CHECK(place->x == kTrackPlace.x);
  CHECK(place->y == doctest::Approx(kTrackPlace.y - other * 15));
  CHECK(seen({{kTrackPlace, 0.9}}, true, other) == kTrackPlace);
}

TEST_CASE("What has left a steady trail is one whatever its score, but only near the track") {
  const auto seen_after = [](const test::Walk& walk) {
    SightingTrails trails;
    const SearchResult last = test::show(trails, walk, kFlatContour, 1'000'000);
    SearchResult without = last;
    without.candidates.front().trail = {};
    CHECK_FALSE(sighting_near(kTrackPlace, 0, without, kFlatContour).has_value());
    return sighting_near(kTrackPlace, 0, last, kFlatContour);
  };
  const auto steady = seen_after({.end = {303, 204}, .velocity = {500, 0}, .searches = 8});
  REQUIRE(steady.has_value());
  CHECK(steady->place == Pixel{303, 204});
  CHECK_FALSE(steady->is_sure);
  CHECK_FALSE(steady->is_certain);
  const auto certain =
      seen_after({.end = {303, 204}, .velocity = {500, 0}, .score = 0.51, .searches = 12});
  REQUIRE(certain.has_value());
  CHECK(certain->is_sure);
  CHECK(certain->is_certain);
  CHECK_FALSE(seen_after({.end = {303, 204}, .velocity = {500, 0}, .searches = 5}).has_value());
  CHECK_FALSE(seen_after({.end = {310, 200}, .velocity = {500, 0}}).has_value());
}

}  // namespace
}  // namespace puck
