#include "common/vision/sighting.h"

#include <vector>

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

using test::kSensor;

constexpr Pixel kTrackPlace{300, 200};

const PuckContour kFlatContour(kSensor, {30, 0, 0, 20, 0, 0}, {0, 0, 0}, true);

std::optional<Pixel> seen(const std::vector<SearchCandidate>& candidates, bool other_wall = false,
                          double wall_share = 0) {
  return sighting_near(kTrackPlace, wall_share, {{}, {.other_wall = other_wall}, candidates},
                       kFlatContour);
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

}  // namespace
}  // namespace puck
