#include "common/vision/contour/peak_refinement.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/vision/ring_picture.h"

namespace puck {
namespace {

RefinedPeak refine(const Image<std::uint8_t>& picture, const ContourRing& ring, Pixel start) {
  RingSamples samples;
  samples.gather(picture.view(), {0, 0, picture.width(), picture.height()}, ring, start);
  return refine_peak(samples, {});
}

}  // namespace

TEST_CASE("a ring is found to a seventh of the way, to a twentieth of a pixel when near") {
  for (const double semi : {8.0, 15.0, 28.0}) {
    for (const Pixel off : {Pixel{0, 0}, {0.3, -0.25}, {-0.7, 0.6}, {1.2, 0.4}}) {
      CAPTURE(semi);
      CAPTURE(off.x);
      const Pixel centre{50 + off.x, 45 + off.y};
      const auto picture = test::draw_ring(100, 90, {centre, semi, 0.65 * semi, 0});
      const RefinedPeak peak = refine(picture, {semi, 0.65 * semi, 0, 0}, {50, 45});
      const double near_px = std::max(0.05, std::hypot(off.x, off.y) / 7);
      CHECK(std::abs(peak.shift.x - off.x) < near_px);
      CHECK(std::abs(peak.shift.y - off.y) < near_px);
    }
  }
}

TEST_CASE("the start is kept without bright pixels") {
  const RefinedPeak peak = refine(Image<std::uint8_t>(100, 90), {15, 10, 0, 0}, {50, 45});
  CHECK(peak.shift == Pixel{});
  CHECK(peak.hold_xx == 0);
  CHECK(peak.hold_yy == 0);
}

TEST_CASE("the peak does not drift along an edge, and not beyond its limit") {
  Image<std::uint8_t> edge(100, 90);
  for (int y = 37; y <= 38; ++y) std::fill_n(edge.row(y), 100, std::uint8_t{255});
  // The ring's upper end lies at row 35: the edge pulls it down.
  const RefinedPeak peak = refine(edge, {15, 10, 0, 0}, {50, 45});
  CHECK(std::abs(peak.shift.x) < 0.05);
  CHECK(peak.shift.y > 0.5);
  CHECK(peak.shift.y <= 2);
  CHECK(peak.hold_yy > 5 * peak.hold_xx);
}

TEST_CASE("a longer ring fixes its peak more strongly") {
  const auto small = test::draw_ring(100, 90, {{50, 45}, 8, 6, 0});
  const auto large = test::draw_ring(100, 90, {{50, 45}, 24, 18, 0});
  CHECK(refine(large, {24, 18, 0, 0}, {50, 45}).hold_xx >
        2 * refine(small, {8, 6, 0, 0}, {50, 45}).hold_xx);
}

}  // namespace puck
