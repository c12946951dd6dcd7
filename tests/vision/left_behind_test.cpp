#include "common/vision/left_behind.h"

#include <optional>

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

constexpr Pixel kRestPlace{300, 180};

// A puck that was seen to glide, and rests at kRestPlace; then a track that something leads away.
class Disturbed {
 public:
  explicit Disturbed(Pixel place = kRestPlace, double wall_share = 0) {
    context.is_trusted = true;
    learn_events_each(5);
    if (wall_share != 0) context.contour.correct_other_wall_share(wall_share);
    track.emplace(context, ContourFilter::Start{.position = place}, 0, wall_share);
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

  // A track at the start of something's way.
  test::MovingContour begin_track(Pixel start, PixelVelocity velocity) {
    track.emplace(context, ContourFilter::Start{.position = start, .velocity = velocity}, now_us,
                  0);
    return test::MovingContour(context.contour, start, velocity);
  }

  void follow(ContourEvent event, std::int64_t began_us) {
    event.time_us += began_us;
    track->take(event, context);
  }

  void decide() {
    now_us += 1'000;
    track->decide(now_us, false, context);
  }

  // Something that looks like a puck glides by for 20 ms from `start`, upon it a track that sees
  // no events, so that it looks bad; whether the track was brought back.
  bool glide(Pixel start, PixelVelocity velocity) {
    test::MovingContour shape = begin_track(start, velocity);
    bool is_back = false;
    const std::int64_t from_us = now_us;
    while (now_us < from_us + 20'000) {
      for (const ContourEvent& event : shape.events(now_us - from_us, now_us - from_us + 1'000)) {
        left_behind.take(event.x, event.y);
      }
      decide();
      is_back = is_brought_back() || is_back;
    }
    return is_back;
  }

  // … past the place, a puck's width to its right.
  bool glide_beside() {
    const double width = 2 * context.contour.ring_at(kRestPlace, 0).semi_x;
    return glide({kRestPlace.x + width, kRestPlace.y - 20}, {0, 1'000});
  }

  // A track follows something that glides by, two widths to the right of the place, for 40 ms,
  // while so many events a millisecond lie beside that; its quality in the end.
  double follow_away(int clutter) {
    const ContourRing ring = context.contour.ring_at(kRestPlace, 0);
    const Pixel start{kRestPlace.x + 4 * ring.semi_x, kRestPlace.y - 20};
    const PixelVelocity velocity{0, 1'000};
    test::MovingContour shape = begin_track(start, velocity);
    const std::int64_t began_us = now_us;
    for (std::int64_t t = 0; t < 40'000; t += 1'000) {
      for (const ContourEvent& event : shape.events(t, t + 1'000)) follow(event, began_us);
      const Pixel place = shape.position_at(t + 1'000);
      for (int i = 0; i < clutter; ++i) {
        track->take({now_us + 999, place.x + ring.semi_x + 4, place.y - 10 + i % 21, true, true},
                    context);
      }
      decide();
    }
    return track->quality();
  }

  // A puck arrives at kRestPlace within 60 ms and does not rest there; `is_whole`: its left half is
  // seen, too.
  void arrive(PixelVelocity velocity, bool is_whole = true) {
    const Pixel start{kRestPlace.x - 0.06 * velocity.x, kRestPlace.y - 0.06 * velocity.y};
    test::MovingContour shape = begin_track(start, velocity);
    const std::int64_t began_us = now_us;
    for (std::int64_t t = 0; t < 60'000; t += 1'000) {
      for (const ContourEvent& event : shape.events(t, t + 1'000)) {
        if (is_whole || event.x > shape.position_at(t).x) follow(event, began_us);
      }
      decide();
      is_brought_back();
    }
  }

  bool is_brought_back() {
    return left_behind.bring_back(*track, {true, false, test::kSensor}, context, now_us);
  }

  // A track without events, 40 px to the right of the place, is brought back at that time.
  bool is_back_from_afar(std::int64_t time_us) {
    now_us = time_us;
    track.emplace(context, ContourFilter::Start{.position = {kRestPlace.x + 40, kRestPlace.y}}, 0,
                  0);
    track->decide(now_us, false, context);
    return is_brought_back();
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
  CHECK(distance_px(puck.track->filter().position(), kRestPlace) < 0.01);
  CHECK(puck.track->filter().speed_px_s() == 0);
}

TEST_CASE("A track follows a puck that leaves") {
  Disturbed puck;
  puck.rest();
  CHECK_FALSE(puck.glide(kRestPlace, {2'500, 0}));
  CHECK_FALSE(puck.left_behind.is_there());
  CHECK(puck.left_behind.region().empty());
}

TEST_CASE("The track may be bad for 5 ms") {
  Disturbed puck;
  puck.rest();
  CHECK_FALSE(puck.is_back_from_afar(104'999));
  CHECK(puck.left_behind.is_there());
  CHECK(puck.is_back_from_afar(105'000));
}

TEST_CASE("A second after the puck rested, events that got lost may be all that is missing") {
  Disturbed puck;
  puck.rest();
  CHECK(puck.is_back_from_afar(1'099'999));
  CHECK_FALSE(puck.is_back_from_afar(1'100'000));
  CHECK_FALSE(puck.left_behind.is_there());
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

TEST_CASE("The place of a slow puck is watched before it rests") {
  Disturbed puck;
  const double slow_px_s = puck.context.contour.turning_px_s() / 2;
  puck.arrive({0.8 * slow_px_s, 0});
  REQUIRE_FALSE(puck.left_behind.region().empty());
  CHECK(puck.glide_beside());
  CHECK(distance_px(puck.track->filter().position(), kRestPlace) < 1);

  Disturbed fast;
  fast.arrive({1.2 * slow_px_s, 0});
  CHECK(fast.left_behind.region().empty());
  CHECK_FALSE(fast.glide_beside());
}

TEST_CASE("The place of a slow puck is not known while it is hidden in part") {
  Disturbed puck;
  puck.arrive({0.4 * puck.context.contour.turning_px_s(), 0}, false);
  CHECK(puck.left_behind.region().empty());
}

TEST_CASE("Where a track stopped for lack of events no place is watched") {
  Disturbed puck;
  puck.arrive({2 * puck.context.contour.turning_px_s(), 0});
  REQUIRE(puck.track->quality() > 0.7);
  REQUIRE(puck.left_behind.region().empty());
  puck.track->stop_at(kRestPlace, puck.now_us, puck.context);
  puck.is_brought_back();
  CHECK(puck.left_behind.region().empty());
  // Nor does a stray event make it a slow puck.
  const ContourRing ring = puck.context.contour.ring_at(kRestPlace, 0);
  puck.track->take(
      {puck.now_us + 500, kRestPlace.x + ring.semi_x + 1, kRestPlace.y - ring.rise, true, true},
      puck.context);
  puck.decide();
  REQUIRE(puck.track->filter().speed_px_s() > 1);
  REQUIRE(puck.track->quality() > 0.7);
  puck.is_brought_back();
  CHECK(puck.left_behind.region().empty());
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
  const auto is_watched = [](Pixel place, double wall_share = 0) {
    Disturbed puck(place, wall_share);
    puck.rest();
    return !puck.left_behind.region().empty();
  };
  const ContourContext context = test::contour_context();
  const auto ring_at = [&](Pixel place) { return context.contour.ring_at(place, 0); };
  const double left = ring_at({20, 180}).half_width();
  CHECK_FALSE(is_watched({left - 1, 180}));
  CHECK(is_watched({left + 1, 180}));
  const double right = 640 - ring_at({620, 180}).half_width();
  CHECK_FALSE(is_watched({right + 1, 180}));
  CHECK(is_watched({right - 1, 180}));
  const double top = ring_at({300, 5}).semi_y;
  CHECK_FALSE(is_watched({300, top - 1}));
  CHECK(is_watched({300, top + 1}));
  const double bottom = 480 - ring_at({300, 460}).semi_y;
  CHECK_FALSE(is_watched({300, bottom + 1}));
  CHECK(is_watched({300, bottom - 1}));
  // The ring of a wall that makes events lies below the puck's face.
  const ContourRing low = context.contour.ring_at({300, 460}, -0.2);
  REQUIRE(low.rise < -2);
  CHECK_FALSE(is_watched({300, 480 - low.semi_y + low.rise + 1}, -0.2));
  CHECK(is_watched({300, 480 - low.semi_y + low.rise - 1}, -0.2));
}

// A puck that rested, and a track that followed something away from it with so much clutter that
// its quality lies in between.
Disturbed followed_away(int clutter, double least_quality, double most_quality) {
  Disturbed puck;
  puck.rest();
  const double quality = puck.follow_away(clutter);
  CHECK(quality > least_quality);
  CHECK(quality < most_quality);
  return puck;
}

TEST_CASE("A track is bad below a quality of 0.7, and from 0.85 on it is where the puck is") {
  Disturbed bad = followed_away(200, 0.6, 0.7);
  CHECK(bad.is_brought_back());

  Disturbed poor = followed_away(130, 0.7, 0.8);
  CHECK_FALSE(poor.is_brought_back());
  CHECK(poor.left_behind.is_there());

  Disturbed sound = followed_away(0, 0.85, 1);
  CHECK_FALSE(sound.is_brought_back());
  CHECK_FALSE(sound.left_behind.is_there());
  CHECK(sound.left_behind.region().empty());
}

TEST_CASE("What has been brought back is as sure of its place as a puck at rest") {
  Disturbed puck = followed_away(200, 0.6, 0.7);
  REQUIRE(puck.is_brought_back());
  CHECK(puck.track->filter().distance_variance(1, 0) < 0.2);
  puck.rest();
  CHECK_FALSE(puck.left_behind.is_there());
  CHECK_FALSE(puck.left_behind.region().empty());
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
