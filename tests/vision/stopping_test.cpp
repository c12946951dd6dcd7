#include "common/vision/stopping.h"

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

// A track that has followed a puck for 100 ms, and what was learned from it.
struct Followed {
  Followed() {
    test::MovingContour puck(context.contour, {100, 180}, {700, 300});
    for (std::int64_t t = 0; t < kEnd_us; t += 1'000) {
      for (const ContourEvent& event : puck.events(t, t + 1'000)) track.take(event, context);
      track.decide(t + 1'000, false, context);
      context.signature.learn(track.take_sample(), 1'000);
    }
    place = puck.position_at(kEnd_us);
  }
  // After so long without an event of the puck.
  bool stops(std::int64_t silent_us) {
    track.decide(kEnd_us + silent_us, false, context);
    stop_if_silent(track, context, kEnd_us + silent_us);
    return track.filter().speed_px_s() == 0;
  }

  static constexpr std::int64_t kEnd_us = 100'000;
  ContourContext context = test::contour_context();
  ContourTrack track{context, {.position = {100, 180}, .velocity = {700, 300}}, 0, 0};
  Pixel place;
};

TEST_CASE("A fast puck that falls silent for more than 3 ms has stopped where it was") {
  CHECK_FALSE(Followed().stops(2'500));
  Followed followed;
  REQUIRE(followed.context.signature.density() > 1);
  CHECK(followed.stops(4'000));
  CHECK(distance_px(followed.track.filter().position(), followed.place) < 0.5);
}

TEST_CASE("What spoke for a faint puck before it stopped does not count any more") {
  Followed followed;
  REQUIRE(followed.track.is_good());
  REQUIRE(followed.context.signature.is_faint());
  REQUIRE(followed.stops(4'000));
  CHECK(followed.track.looks().near_events == 0);
  CHECK_FALSE(followed.track.is_good());
}

TEST_CASE("A puck that something covers has not stopped") {
  Followed followed;
  for (int i = 0; i < 5'000; ++i) {
    followed.track.take({Followed::kEnd_us + 1'000, followed.place.x, followed.place.y, true, true},
                        followed.context);
  }
  CHECK_FALSE(followed.stops(4'000));
}

TEST_CASE("Stopping can be switched off") {
  Followed followed;
  followed.context.ingredients.stopping = false;
  CHECK_FALSE(followed.stops(4'000));
}

TEST_CASE("A track ends 15 px outside the image") {
  const ContourContext context = test::contour_context();
  ContourTrack track(context, {.position = {-14, 200}, .velocity = {-900, 0}}, 0, 0);
  CHECK_FALSE(stop_beyond_image(track, context, test::kSensor, 0));
  CHECK(track.filter().velocity().x == -900);
  track.decide(2'000, false, context);
  CHECK(stop_beyond_image(track, context, test::kSensor, 2'000));
  CHECK(track.filter().position().x == -15);
  CHECK(track.filter().speed_px_s() == 0);
}

}  // namespace
}  // namespace puck
