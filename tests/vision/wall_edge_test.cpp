#include "common/vision/wall_edge.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

// Of a puck whose wall is 6 px high in the image.
constexpr ContourRing kWhole{.semi_x = 20, .semi_y = 13};
constexpr ContourRing kFace{.semi_x = 20, .semi_y = 10, .rise = 3};

TEST_CASE("Where the whole puck is followed, its face's lower edge is the other one") {
  const WallEdge edge(kWhole, kFace);
  CHECK(edge.contains(0, 7, 0));
  CHECK(edge.contains(0, 8.4, 0));
  CHECK(edge.contains(0, 5.6, 0));
  CHECK_FALSE(edge.contains(0, 8.6, 0));
  CHECK_FALSE(edge.contains(0, 5.4, 0));
  CHECK_FALSE(edge.contains(0, 0, 0));
  CHECK(edge.contains(0, 8.6, 1));
}

TEST_CASE("Where the face is followed, it is the lower edge of the whole") {
  const WallEdge edge(kFace, kWhole);
  CHECK(edge.contains(0, 13, 0));
  CHECK_FALSE(edge.contains(0, 10, 0));
  CHECK_FALSE(edge.contains(0, 15, 0));
}

TEST_CASE("It takes its share of the areas in which events count against the ring") {
  const RingAreas whole = RingEvidence::areas_of(kWhole);
  const RingAreas inside = WallEdge(kWhole, kFace).areas();
  CHECK(inside.ring == whole.ring);
  CHECK(inside.outside == whole.outside);
  // Half of a band of 3 px.
  CHECK(whole.inside - inside.inside == doctest::Approx(kFace.band_area(1.5) / 2));
  const RingAreas face = RingEvidence::areas_of(kFace);
  const RingAreas outside = WallEdge(kFace, kWhole).areas();
  CHECK(outside.inside == face.inside);
  CHECK(face.outside - outside.outside == doctest::Approx(kWhole.band_area(1.5) / 2));
}

TEST_CASE("A wall that is lower than a ring is wide takes no more than there is") {
  constexpr ContourRing kLow{.semi_x = 20, .semi_y = 12, .rise = 1};
  const RingAreas whole = RingEvidence::areas_of(kWhole);
  CHECK(WallEdge(kWhole, kLow).areas().inside == doctest::Approx(kLow.inside_area(1.5)));
  CHECK(whole.inside - kLow.inside_area(1.5) < kLow.band_area(1.5) / 2);
}

TEST_CASE("A puck without a wall has no such edge") {
  const WallEdge edge(kWhole, kWhole);
  CHECK_FALSE(edge.contains(0, 13, 0));
  CHECK(edge.areas().inside == RingEvidence::areas_of(kWhole).inside);
  CHECK_FALSE(WallEdge().contains(0, 0, 0));
}

}  // namespace
}  // namespace puck
