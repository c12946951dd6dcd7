#include "common/vision/left_behind.h"

#include <optional>

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

constexpr Pixel kPlace{300, 180};

// A puck that was seen to glide, and rests at kPlace; then a track that something leads away.
class Disturbed {
 public:
  explicit Disturbed(Pixel place = kPlace) {
    context.is_trusted = true;
    learn_events_each(5);
    track.emplace(context, ContourFilter::Start{.position = place}, 0, 0);
  }

  // The puck turns out to make so many events at each pixel.
  void learn_events_each(double events_each) {
    context.signature = {};
    context.signature.learn({.events = 9'000,
                             .swept_px2 = 3'000,
                             .quick_events = 300,
                             .first_events = 300 / events_each},
                            1'000);
  }

  void rest(bool is_sure = true) {
    track->decide(now_us, false, context);
    left_behind.bring_back(*track, {is_sure, true, test::kSensor}, context, now_us);
  }

  // Something that looks like a puck glides by for 20 ms from `start`, upon it a track that sees
  // no events, so that it looks bad; whether the track was brought back.
  bool glide(Pixel start, PixelVelocity velocity) {
    test::MovingContour shape(context.contour, start, velocity);
    bool is_back = false;
    const std::int64_t from_us = now_us;
    track.emplace(context, ContourFilter::Start{.position = start, .velocity = velocity}, now_us,
                  0);
    while (now_us < from_us + 20'000) {
      for (const ContourEvent& event : shape.events(now_us - from_us, now_us - from_us + 1'000)) {
        left_behind.take(event.x, event.y);
      }
      now_us += 1'000;
      track->decide(now_us, false, context);
      is_back =
          left_behind.bring_back(*track, {true, false, test::kSensor}, context, now_us) || is_back;
    }
    return is_back;
  }

  // … past the place, a puck's width to its right.
  bool glide_beside() {
    const double width = 2 * context.contour.ring_at(kPlace, 0).semi_x;
    return glide({kPlace.x + width, kPlace.y - 20}, {0, 1'000});
  }

  ContourContext context = test::contour_context();
  LeftBehind left_behind;
  std::optional<ContourTrack> track;
  std::int64_t now_us = 100'000;
};

TEST_CASE("A bad track beside the place that the puck cannot have left is brought back to rest") {
  Disturbed puck;
  puck.rest();
  CHECK(puck.glide_beside());
  CHECK(puck.left_behind.is_there());
  CHECK(distance_px(puck.track->filter().position(), kPlace) < 0.01);
  CHECK(puck.track->filter().speed_px_s() == 0);
}

TEST_CASE("A track follows a puck that leaves") {
  Disturbed puck;
  puck.rest();
  CHECK_FALSE(puck.glide(kPlace, {2'500, 0}));
  CHECK_FALSE(puck.left_behind.is_there());
  CHECK(puck.left_behind.region().empty());
}

TEST_CASE("The track may be bad for 5 ms") {
  Disturbed puck;
  puck.rest();
  const LeftBehind::Situation astray{true, false, test::kSensor};
  puck.track.emplace(puck.context, ContourFilter::Start{.position = {340, 180}}, 0, 0);
  puck.track->decide(104'999, false, puck.context);
  CHECK_FALSE(puck.left_behind.bring_back(*puck.track, astray, puck.context, 104'999));
  CHECK(puck.left_behind.is_there());
  CHECK(puck.left_behind.bring_back(*puck.track, astray, puck.context, 105'000));
}

TEST_CASE("Nothing is brought back without a rest beyond doubt, or with it switched off") {
  Disturbed unsure;
  unsure.rest(false);
  CHECK_FALSE(unsure.glide_beside());
  Disturbed off;
  off.context.ingredients.left_behind = false;
  off.rest();
  CHECK_FALSE(off.glide_beside());
}

TEST_CASE("A faint puck may leave unseen") {
  Disturbed puck;
  puck.learn_events_each(1);
  REQUIRE(puck.context.signature.is_faint());
  REQUIRE(puck.context.signature.last_density() > 0);
  puck.rest();
  CHECK_FALSE(puck.glide_beside());
}

TEST_CASE("A place is forgotten when the puck turns out to be faint") {
  Disturbed puck;
  puck.rest();
  REQUIRE(puck.glide_beside());
  REQUIRE(puck.left_behind.is_there());
  puck.learn_events_each(1);
  CHECK_FALSE(puck.glide_beside());
  CHECK_FALSE(puck.left_behind.is_there());
  CHECK(puck.left_behind.region().empty());
}

TEST_CASE("A rest at the image's border takes the place of the one before") {
  Disturbed puck;
  puck.rest();
  REQUIRE_FALSE(puck.left_behind.region().empty());
  puck.track.emplace(puck.context, ContourFilter::Start{.position = {2, 180}}, puck.now_us, 0);
  puck.rest();
  CHECK(puck.left_behind.region().empty());
}

TEST_CASE("No place is watched that lies in part outside the image") {
  Disturbed puck({2, 180});
  puck.rest();
  CHECK(puck.left_behind.region().empty());
}

TEST_CASE("Of a place that is forgotten nothing is brought back") {
  Disturbed puck;
  puck.rest();
  puck.left_behind.forget();
  CHECK_FALSE(puck.glide_beside());
  CHECK_FALSE(puck.left_behind.is_there());
}

}  // namespace
}  // namespace puck
