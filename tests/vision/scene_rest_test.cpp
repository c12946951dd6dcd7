#include "common/vision/scene_rest.h"

#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"
#include "tests/vision/random_numbers.h"
#include "tests/vision/turning_scene.h"

namespace puck {
namespace {

using test::TurningScene;

// A puck on the table beneath a swaying head, with a track on it.
class Beneath {
 public:
  Beneath() {
    scene_.show(background, 300);
    track = ContourTrack(context, {.position = place()}, scene_.time_us(), 0);
  }

  // Where it is, if it has not been moved.
  Pixel place() const { return {300 + TurningScene::sway_px(scene_.time_us()), 180}; }
  double off_px() const { return distance_px(track.filter().position(), place()); }

  // Each millisecond so many events lie on the contour of a puck that moves in the scene, and so
  // many on the edge of something to the right of where it lay.
  void pass(int milliseconds, int events, double own_px_s = 0, int beside = 0) {
    for (int i = 0; i < milliseconds; ++i) {
      scene_.show(background, 1);
      moved_px_ += own_px_s * 1e-3;
      const Pixel centre{place().x + moved_px_, place().y};
      const ContourRing ring = context.contour.ring_at(centre, 0);
      for (int n = 0; n < events; ++n) {
        const double angle = 2 * std::numbers::pi * random_.below(1'000) / 1'000;
        take(centre.x + ring.semi_x * std::cos(angle),
             centre.y - ring.rise + ring.semi_y * std::sin(angle), std::cos(angle) < 0);
      }
      for (int n = 0; n < beside; ++n) {
        take(place().x + ring.semi_x + 2 + random_.below(2), place().y - 5 + random_.below(10),
             true);
      }
      track.decide(scene_.time_us(), false, context);
      rest.hold(track, background, context, scene_.time_us());
    }
  }

  Background background{TurningScene::kSensor};
  ContourContext context = test::contour_context();
  ContourTrack track{context, {}, 0, 0};
  SceneRest rest;

 private:
  void take(double x, double y, bool on) {
    track.take({.time_us = scene_.time_us(),
                .x = std::round(x),
                .y = std::round(y),
                .on = on,
                .first = true},
               context);
  }

  TurningScene scene_;
  test::RandomNumbers random_;
  double moved_px_ = 0;
};

// It has been seen for 60 ms.
Beneath lying() {
  Beneath world;
  world.pass(60, 8);
  REQUIRE(world.rest.is_held());
  return world;
}

TEST_CASE("A puck that lies beneath a turning head stays in the scene for half a second unseen") {
  Beneath world;
  world.pass(5, 8);
  CHECK_FALSE(world.rest.is_held());
  world.pass(55, 8);
  REQUIRE(world.track.is_good());
  REQUIRE(world.rest.is_held());
  const Pixel before = world.place();
  world.pass(480, 0);
  CHECK(world.rest.is_held());
  REQUIRE(distance_px(before, world.place()) > 10);
  CHECK(world.off_px() < 2);
  world.pass(100, 0);
  CHECK_FALSE(world.rest.is_held());
}

TEST_CASE("It stays whatever comes for it, which leads the track away without the ingredient") {
  for (const bool is_on : {true, false}) {
    Beneath world;
    world.context.ingredients.scene_rests = is_on;
    world.pass(60, 8);
    CHECK(world.rest.is_held() == is_on);
    world.pass(100, 0, 0, 20);
    CHECK_FALSE(world.track.is_good());
    if (is_on) {
      CHECK(world.off_px() < 2);
    } else {
      CHECK(world.off_px() > 3);
    }
  }
}

TEST_CASE("What moves against the scene does not lie in it, nor what has been set off") {
  Beneath moving;
  moving.pass(60, 20, 400);
  REQUIRE(moving.track.is_good());
  CHECK_FALSE(moving.rest.is_held());
  Beneath pushed = lying();
  for (int speed = 10; speed <= 450; speed += 10) pushed.pass(2, 20, speed);
  REQUIRE(pushed.track.is_good());
  CHECK_FALSE(pushed.rest.is_held());
}

TEST_CASE("A puck that is moved slowly is held no more once it is seen elsewhere") {
  Beneath world = lying();
  for (int speed = 10; speed <= 150; speed += 10) world.pass(2, 20, speed);
  world.pass(60, 20, 150);
  REQUIRE(world.track.is_good());
  REQUIRE(world.off_px() > 8);
  CHECK_FALSE(world.rest.is_held());
}

TEST_CASE("What is trusted is not held, nor a puck of which it is known whether it is faint") {
  Beneath trusted;
  trusted.context.is_trusted = true;
  trusted.pass(60, 8);
  REQUIRE(trusted.track.is_good());
  CHECK_FALSE(trusted.rest.is_held());
  Beneath known = lying();
  PuckSignature::Sample sample;
  for (int i = 0; i < 100; ++i) sample.count(true, -500, true);  // of a dark one
  known.context.signature.learn(sample, 1'000);
  REQUIRE(known.context.signature.knows_multiplicity());
  known.pass(1, 8);
  CHECK_FALSE(known.rest.is_held());
}

TEST_CASE("Once the scene is forgotten it is not known where in it the puck lies") {
  Beneath world = lying();
  world.background.forget();
  world.pass(60, 0);
  CHECK_FALSE(world.rest.is_held());
}

TEST_CASE("Another track does not lie where the last one did") {
  Beneath world = lying();
  world.rest.forget();
  CHECK_FALSE(world.rest.is_held());
  world.pass(5, 8);
  CHECK_FALSE(world.rest.is_held());
}

}  // namespace
}  // namespace puck
