#include "common/vision/contour_track.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

double error_px(const ContourTrack& track, Pixel truth) {
  return distance_px(track.filter().position(), truth);
}

TEST_CASE("A track that starts 2 px off finds a moving puck to a few tenths of a pixel") {
  const ContourContext all = test::contour_context();
  const PixelVelocity velocity{700, 300};
  test::MovingContour puck(all.contour, {250, 180}, velocity);
  ContourTrack track(all, {.position = {252, 179}}, 0, 0);
  CHECK(test::follow(track, puck, all, 0, 60'000) < 0.25);
  CHECK(track.is_good());
  CHECK(track.quality() > 0.8);
  CHECK(track.filter().velocity().x == doctest::Approx(700).epsilon(0.05));
  CHECK(track.filter().velocity().y == doctest::Approx(300).epsilon(0.1));
  CHECK(track.looks().turning_px_s == all.contour.turning_px_s());
  CHECK(track.looks().slide == track.filter().slide());
}

TEST_CASE("A sensor's lag is made good") {
  ContourContext all = test::contour_context();
  test::MovingContour puck(all.contour, {200, 180}, {2000, 0});
  // Events that come 0.5 ms late show the puck 1 px behind.
  all.contour = PuckContour(test::kSensor, test::kSizeModel, {500, 0, 0}, true);
  ContourTrack track(all, {.position = {200, 180}, .velocity = {2000, 0}}, 500, 0);
  for (std::int64_t t = 0; t < 40'000; t += 1000) {
    for (ContourEvent event : puck.events(t, t + 1000)) {
      event.time_us += 500;
      track.take(event, all);
    }
    track.decide(t + 1500, false, all);
  }
  CHECK(error_px(track, puck.position_at(track.filter().time_us())) < 0.3);
}

TEST_CASE("Nothing is believed where events lie everywhere") {
  const ContourContext all = test::contour_context();
  ContourTrack track(all, {.position = {300, 200}}, 0, 0);
  std::uint32_t random = 1;
  for (std::int64_t t = 0; t < 40'000; t += 10) {
    random = random * 1664525u + 1013904223u;
    track.take({t, 270.0 + (random >> 8) % 60, 170.0 + (random >> 20) % 60, true, true}, all);
    if (t % 1000 == 0) track.decide(t, false, all);
  }
  CHECK_FALSE(track.is_good());
  CHECK(track.quality() < 0.2);
}

TEST_CASE("A hot pixel neither moves a puck at rest nor makes it look disturbed") {
  const ContourContext all = test::contour_context();
  ContourTrack track(all, {.position = {300, 200}}, 0, 0);
  const ContourRing ring = all.contour.ring_at({300, 200}, 0);
  for (std::int64_t t = 1'000; t <= 100'000; t += 1'000) {
    track.take({t, 300 + std::floor(ring.semi_x), 200 - std::floor(ring.rise), true, true}, all);
    track.decide(t, false, all);
    track.park();
    if (t > 20'000) CHECK(track.looks().is_quiet());
  }
  CHECK(error_px(track, {300, 200}) < 0.5);
}

}  // namespace
}  // namespace puck
