#include "common/vision/settling.h"

#include <optional>

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"
#include "tests/vision/random_numbers.h"

namespace puck {
namespace {

// A track that follows a puck for 100 ms, which then stands still at once. Meanwhile each pixel
// fires so many times a second by itself.
class Stopped {
 public:
  explicit Stopped(PixelVelocity velocity, double noise_hz = 0, bool is_noise_known = true) {
    if (is_noise_known) context.noise_per_pixel_us = noise_hz * 1e-6;
    context.is_trusted = true;
    test::MovingContour puck(context.contour, {300, 180}, velocity);
    track.emplace(context, ContourFilter::Start{.position = {300, 180}, .velocity = velocity}, 0,
                  0);
    for (; now_us < 100'000; now_us += 1'000) {
      for (ContourEvent event : puck.events(now_us, now_us + 1'000)) {
        event.first = false;  // as of a puck of good contrast
        track->take(event, context);
      }
      const int noise_a_ms = static_cast<int>(noise_hz * 120 * 100 * 1e-3);
      for (int n = 0; n < noise_a_ms; ++n) {
        track->take({.time_us = now_us + 999,
                     .x = 240.0 + random_.below(120),
                     .y = 130.0 + random_.below(100),
                     .on = random_.below(2) == 1},
                    context);
      }
      decide(now_us + 1'000);
      context.signature.learn(track->take_sample(), 1'000);
    }
    place = puck.position_at(now_us);
  }

  // Every 10 ms, or so often, an event of noise lies 2 px outside the contour, on its right, no two
  // in a row at the same pixel; whether the track has been put to rest.
  bool wait(std::int64_t duration_us, std::int64_t each_us = 10'000) {
    const ContourRing ring = context.contour.ring_at(place, 0);
    bool settled = false;
    for (const std::int64_t end_us = now_us + duration_us; now_us < end_us; now_us += each_us) {
      const auto row = static_cast<double>(now_us / each_us % 7 - 3);
      track->take({.time_us = now_us + each_us / 2,
                   .x = place.x + ring.semi_x + 2,
                   .y = place.y - ring.rise + row,
                   .on = true,
                   .first = true},
                  context);
      settled = decide(now_us + each_us) || settled;
    }
    return settled;
  }

  // Another track, of which there are no events yet, takes over where this one is.
  void succeed() {
    track.emplace(context, ContourFilter::Start{.position = track->filter().position()}, now_us, 0);
    settling_.forget();
  }

  ContourContext context = test::contour_context();
  std::optional<ContourTrack> track;
  Pixel place;
  std::int64_t now_us = 0;
  bool was_covered = false;

 private:
  bool decide(std::int64_t time_us) {
    track->decide(time_us, false, context);
    return settling_.settle(*track, context, was_covered, time_us);
  }

  Settling settling_;
  test::RandomNumbers random_;
};

TEST_CASE("A slow puck whose events die away rests where it was last seen clearly") {
  Stopped stopped({35, 10});
  CHECK(stopped.wait(50'000));
  CHECK(stopped.track->filter().speed_px_s() == 0);
  CHECK(distance_px(stopped.track->filter().position(), stopped.place) < 0.7);
}

TEST_CASE("A puck is clear whatever the sensor's noise around it, if that is known") {
  Stopped known({35, 10}, 2);
  CHECK(known.wait(50'000));
  CHECK(distance_px(known.track->filter().position(), known.place) < 1);
  Stopped unknown({35, 10}, 2, false);
  CHECK_FALSE(unknown.wait(50'000));
}

TEST_CASE("Without it a few stray events lead the track away") {
  Stopped stopped({35, 10});
  stopped.context.ingredients.settling = false;
  CHECK_FALSE(stopped.wait(50'000));
  CHECK(distance_px(stopped.track->filter().position(), stopped.place) > 1.5);
}

TEST_CASE("A puck that is caught while it still goes on rests near where it was caught") {
  Stopped stopped({180, 40});
  CHECK(stopped.wait(80'000));
  CHECK(distance_px(stopped.track->filter().position(), stopped.place) < 3);
}

TEST_CASE("A puck at 150 px/s is slow, one at 260 px/s is not") {
  CHECK(Stopped({150, 0}).wait(50'000));
  CHECK_FALSE(Stopped({260, 0}).wait(50'000));
}

TEST_CASE("A puck whose events do not die away does not settle") {
  Stopped stopped({35, 10});
  CHECK_FALSE(stopped.wait(50'000, 1'000));
}

TEST_CASE("A track that something has led more than 12 px away does not settle") {
  for (const double away_px : {11.0, 13.0}) {
    CAPTURE(away_px);
    Stopped stopped({35, 10});
    const Pixel led_to{stopped.track->filter().position().x + away_px, stopped.place.y};
    stopped.track->stop_at(led_to, stopped.now_us, stopped.context);
    CHECK(stopped.wait(50'000) == (away_px < 12));
  }
}

TEST_CASE("A covered puck's events die away while it goes on, so that it does not settle") {
  Stopped stopped({35, 10});
  stopped.was_covered = true;
  CHECK_FALSE(stopped.wait(50'000));
}

TEST_CASE("A fast puck that falls silent does not settle, since it may be covered") {
  Stopped stopped({500, 0});
  CHECK_FALSE(stopped.wait(50'000));
}

TEST_CASE("A track that is not trusted does not settle, since it may be a mallet's") {
  Stopped stopped({35, 10});
  stopped.context.is_trusted = false;
  CHECK_FALSE(stopped.wait(50'000));
}

TEST_CASE("A successor does not settle where the track before it was clear") {
  Stopped stopped({35, 10});
  stopped.succeed();
  CHECK_FALSE(stopped.wait(50'000));
}

TEST_CASE("Where a puck was clear more than 150 ms ago says nothing any more") {
  Stopped soon({35, 10});
  soon.now_us += 120'000;
  CHECK(soon.wait(10'000));
  Stopped late({35, 10});
  late.now_us += 150'000;
  CHECK_FALSE(late.wait(50'000));
}

TEST_CASE("A faint puck may be silent while it goes on, so that 80 ms are too long") {
  for (const std::int64_t silent_us : {60'000, 80'000}) {
    CAPTURE(silent_us);
    Stopped faint({35, 10});
    faint.context.signature = {};
    faint.context.signature.learn({.quick_events = 300, .first_events = 300}, 1'000);
    REQUIRE(faint.context.signature.is_faint());
    faint.now_us += silent_us;
    CHECK(faint.wait(10'000) == (silent_us < 80'000));
  }
}

}  // namespace
}  // namespace puck
