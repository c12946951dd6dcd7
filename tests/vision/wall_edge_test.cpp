#include "common/vision/wall_edge.h"

#include <array>
#include <cmath>

#include <doctest/doctest.h>

namespace puck {
namespace {

// Of a puck whose wall is 6 px high in the image.
constexpr ContourRing kWhole{.semi_x = 20, .semi_y = 13};
constexpr ContourRing kFace{.semi_x = 20, .semi_y = 10, .rise = 3};

// Counts the pixels of 0.1 by 0.1 px that lie on the edge and farther from the ring than 1.5 px,
// but no farther outside than 7: first inside the ring, then outside.
std::array<double, 2> counted(const ContourRing& ring, const ContourRing& edge) {
  std::array<double, 2> areas{};
  for (double y = -40; y < 40; y += 0.1) {
    for (double x = -40; x < 40; x += 0.1) {
      const double from_ring = ring.offset(x, y, 0).distance_px;
      const double from_edge = edge.offset(x, y, 0).distance_px;
      if (std::abs(from_edge) > 1.5 || std::abs(from_ring) <= 1.5 || from_ring > 7) continue;
      areas.at(from_ring > 0 ? 1 : 0) += 0.01;
    }
  }
  return areas;
}

TEST_CASE("The edge takes its share of the areas in which events count against the ring") {
  const RingAreas whole = RingEvidence::areas_of(kWhole);
  const RingAreas inside = WallEdge(kWhole, kFace).areas();
  CHECK(inside.ring == whole.ring);
  CHECK(inside.outside == whole.outside);
  CHECK(whole.inside - inside.inside == doctest::Approx(counted(kWhole, kFace)[0]).epsilon(0.15));
  const RingAreas face = RingEvidence::areas_of(kFace);
  const RingAreas outside = WallEdge(kFace, kWhole).areas();
  CHECK(outside.inside == face.inside);
  CHECK(face.outside - outside.outside == doctest::Approx(counted(kFace, kWhole)[1]).epsilon(0.15));
}

TEST_CASE("Of a high wall most lies too far outside to count") {
  constexpr ContourRing kHigh{.semi_x = 20, .semi_y = 17, .rise = -7};
  REQUIRE(kHigh.semi_y - kHigh.rise - kFace.semi_y + kFace.rise > 15);
  const double taken =
      RingEvidence::areas_of(kFace).outside - WallEdge(kFace, kHigh).areas().outside;
  CHECK(taken == doctest::Approx(counted(kFace, kHigh)[1]).epsilon(0.3));
  CHECK(taken < 0.6 * kHigh.band_area(1.5) / 2);
}

TEST_CASE("Of a puck of few pixels no more is taken than there is") {
  constexpr ContourRing kSmall{.semi_x = 5, .semi_y = 2.2};
  constexpr ContourRing kSmallFace{.semi_x = 5, .semi_y = 2, .rise = 0.2};
  CHECK(WallEdge(kSmall, kSmallFace).areas().inside > 0);
  CHECK(WallEdge(kSmallFace, kSmall).areas().outside > 0);
}

TEST_CASE("A puck without a wall has no such edge") {
  CHECK(WallEdge(kWhole, kFace).is_known());
  CHECK(WallEdge(kFace, kWhole).is_known());
  CHECK_FALSE(WallEdge(kWhole, kWhole).is_known());
  CHECK_FALSE(WallEdge().is_known());
  CHECK(WallEdge(kWhole, kWhole).areas().inside == RingEvidence::areas_of(kWhole).inside);
}

}  // namespace
}  // namespace puck
