#include "common/vision/contour/ring_score.h"

#include <doctest/doctest.h>

#include "tests/vision/ring_picture.h"

namespace puck {
namespace {

constexpr Region kPicture{0, 0, 120, 120};

double score(const Image<std::uint8_t>& picture, const ContourRing& ring, Pixel centre) {
  RingSamples samples;
  samples.gather(picture.view(), {0, 0, picture.width(), picture.height()}, ring, centre);
  return ring_score(samples, {});
}

}  // namespace

TEST_CASE("a whole ring scores the same at every size") {
  for (const double semi : {8.0, 15.0, 30.0}) {
    CAPTURE(semi);
    const test::DrawnRing drawn{{60, 60}, semi, 0.7 * semi, 0};
    const auto picture = test::draw_ring(120, 120, drawn);
    CHECK(score(picture, {semi, 0.7 * semi, 0, 0}, {60, 60}) ==
          doctest::Approx(0.89).epsilon(0.05));
  }
}

TEST_CASE("a ring of half the brightness scores nearly as much as a bright one") {
  auto picture = test::draw_ring(120, 120, {{60, 60}, 15, 10, 0});
  const double bright = score(picture, {15, 10, 0, 0}, {60, 60});
  for (int y = 0; y < 120; ++y) {
    for (int x = 0; x < 120; ++x) picture(x, y) = static_cast<std::uint8_t>(picture(x, y) / 2);
  }
  CHECK(score(picture, {15, 10, 0, 0}, {60, 60}) > bright - 0.08);
}

TEST_CASE("half a ring, a straight edge, a filled disc and nothing score low") {
  const ContourRing ring{15, 10, 0, 0};
  const auto half = test::draw_ring(120, 120, {{60, 60}, 15, 10, 0}, 0, 0.5);
  CHECK(score(half, ring, {60, 60}) < 0.55);

  Image<std::uint8_t> edge(120, 120);
  for (int y = 48; y <= 51; ++y) std::fill_n(edge.row(y), 120, std::uint8_t{255});
  CHECK(score(edge, ring, {60, 60}) < 0.4);

  Image<std::uint8_t> disc(120, 120);
  for (int y = 50; y <= 70; ++y) std::fill_n(disc.row(y) + 45, 31, std::uint8_t{255});
  CHECK(score(disc, ring, {60, 60}) < 0.5);

  CHECK(score(Image<std::uint8_t>(120, 120), ring, {60, 60}) == 0);
}

TEST_CASE("a ring of which half lies outside the image scores less than a whole one") {
  const auto picture = test::draw_ring(120, 120, {{0, 60}, 15, 10, 0});
  const double cut = score(picture, {15, 10, 0, 0}, {0, 60});
  CHECK(cut > 0.5);
  CHECK(cut < 0.75);
}

TEST_CASE("the score follows the ring's shift") {
  const auto picture = test::draw_ring(120, 120, {{61.5, 59}, 15, 10, 0});
  RingSamples samples;
  samples.gather(picture.view(), kPicture, {15, 10, 0, 0}, {60, 60});
  CHECK(ring_score(samples, {1.5, -1}) > ring_score(samples, {}) + 0.05);
}

}  // namespace puck
