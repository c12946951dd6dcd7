#include "common/vision/scene/background.h"

#include <cmath>

#include <doctest/doctest.h>

#include "tests/vision/random_numbers.h"
#include "tests/vision/turning_scene.h"

namespace puck {
namespace {

using test::still_share_of_marks;
using test::TurningScene;

TEST_CASE("What stands still is known as such through a whole sway of the head") {
  Background background(TurningScene::kSensor, TurningScene::kLeastCells);
  TurningScene scene;
  scene.show(background, 300);
  for (int i = 0; i < 9; ++i) {
    scene.show(background, 200);
    REQUIRE(background.is_known());
    CHECK(still_share_of_marks(background, scene.time_us()) > 0.9);
    CHECK_FALSE(background.is_still(140 + TurningScene::sway_px(scene.time_us()), 105));
  }
}

TEST_CASE("How what stands still moves is known to a third of its speed while the head turns") {
  Background background(TurningScene::kSensor, TurningScene::kLeastCells);
  TurningScene scene;
  CHECK_FALSE(background.still_velocity_at({320, 240}));
  scene.show(background, 300);
  double squared_speed = 0;
  double squared_error = 0;
  for (int i = 0; i < 2'000; ++i) {
    scene.show(background, 1);
    const std::int64_t time_us = scene.time_us();
    const double truth_px_s =
        500 * (TurningScene::sway_px(time_us + 1'000) - TurningScene::sway_px(time_us - 1'000));
    const PixelVelocity velocity = background.still_velocity_at({320, 240}).value();
    const double error_px_s = std::hypot(velocity.x - truth_px_s, velocity.y);
    squared_speed += truth_px_s * truth_px_s;
    squared_error += error_px_s * error_px_s;
  }
  MESSAGE("still scene: error " << std::sqrt(squared_error / 2'000) << " px/s rms of "
                                << std::sqrt(squared_speed / 2'000));
  CHECK(squared_error < squared_speed / 9);
}

TEST_CASE("What passes once does not become part of what stands still") {
  Background background(TurningScene::kSensor, TurningScene::kLeastCells);
  TurningScene scene;
  scene.show(background, 300);
  // An edge of one event a pixel, at 1 px a millisecond, where there is no mark.
  for (int i = 0; i < 60; ++i) {
    for (int y = 95; y < 115; ++y) background.take(110 + i, y);
    scene.show(background, 1);
  }
  REQUIRE(background.is_known());
  CHECK_FALSE(background.is_still(150, 105));
}

TEST_CASE("Of a hand alone nothing is known") {
  Background background(TurningScene::kSensor, TurningScene::kLeastCells);
  for (int i = 1; i <= 500; ++i) {
    for (int n = 0; n < 100; ++n) background.take(100 + n % 10, 200 + n / 2);
    background.decide(i * 1'000);
  }
  CHECK_FALSE(background.is_known());
  CHECK_FALSE(background.is_still(105, 220));
}

TEST_CASE("While the head turns most of what is seen stands still, a hand beside it or not") {
  for (const int hand_events : {0, 100}) {
    Background background(TurningScene::kSensor, TurningScene::kLeastCells);
    TurningScene scene;
    scene.show(background, 300);
    for (int i = 0; i < 1'500; ++i) {
      for (int n = 0; n < hand_events; ++n) background.take(150 + i % 300, 100 + n);
      scene.show(background, 1);
      REQUIRE(background.head_turns());
    }
    CHECK(background.still_velocity_at({320, 240}));
  }
}

// These arms are in up to 30 cells, more than the tracker asks for.
TEST_CASE("Arms that go to and fro draw no map of what must be seen in more cells") {
  Background background(TurningScene::kSensor, 34);
  int known = 0;
  for (int i = 1; i <= 3'000; ++i) {
    // Two upright ones against each other; they linger where they turn around.
    const double out = 120 * std::sin(i * 0.006283);
    for (int n = 0; n < 430; ++n) {
      background.take(std::round(160 + out), 20 + n);
      background.take(std::round(480 - out), 20 + n);
    }
    background.decide(i * 1'000);
    known += background.is_known();
  }
  CHECK(known == 0);
}

TEST_CASE("The head rests when, looked at for 300 ms, nothing is known, and not before") {
  Background background(TurningScene::kSensor, TurningScene::kLeastCells);
  std::int64_t time_us = 10'000'000;
  const auto look = [&](int milliseconds) {
    for (int i = 0; i < milliseconds; ++i) background.decide(time_us += 1'000);
    background.work_off();
  };
  look(299);
  CHECK_FALSE(background.head_rests());
  look(2);
  CHECK(background.head_rests());

  TurningScene scene;
  Background turning(TurningScene::kSensor, TurningScene::kLeastCells);
  for (int i = 0; i < 20; ++i) {
    scene.show(turning, 50);
    REQUIRE_FALSE(turning.head_rests());
  }
}

TEST_CASE("The head no longer rests a few milliseconds after it has begun to turn") {
  TurningScene scene;
  Background unused(TurningScene::kSensor, TurningScene::kLeastCells);
  scene.show(unused, 400);
  Background background(TurningScene::kSensor, TurningScene::kLeastCells);
  for (int i = 1; i <= 400; ++i) background.decide(i * 1'000);
  REQUIRE(background.head_rests());
  scene.show(background, 12);
  CHECK_FALSE(background.head_rests());
}

// For how long a head that turns again has to be watched until the background is known, ms; before
// that it has stopped while it turned and has rested for so long.
int known_again_after_ms(int resting_ms, int noise_a_ms) {
  Background background(TurningScene::kSensor, TurningScene::kLeastCells);
  TurningScene scene;
  scene.show(background, 1'000);
  REQUIRE(background.is_known());
  std::int64_t time_us = scene.time_us();
  std::uint32_t random = 1;
  for (int i = 0; i < resting_ms; ++i) {
    time_us += 1'000;
    for (int n = 0; n < noise_a_ms; ++n) {
      random = random * 1664525u + 1013904223u;
      background.take((random >> 8) % 640, (random >> 20) % 480);
    }
    background.decide(time_us);
  }
  scene.wait_until(time_us);
  for (int i = 1; i <= 1'000; ++i) {
    scene.show(background, 1);
    if (background.is_known()) return i;
  }
  return 1'000;
}

TEST_CASE(
    "A head that stops while it turns, and turns again after a rest, is known again at once") {
  for (const int resting_ms : {500, 5'000, 30'000}) {
    for (const int noise_a_ms : {0, 3, 30, 150}) {
      CAPTURE(resting_ms);
      CAPTURE(noise_a_ms);
      CHECK(known_again_after_ms(resting_ms, noise_a_ms) < 100);
    }
  }
}

// A sensor all of whose pixels fire by themselves, 3 times a second; the background is told of it.
class NoisyScene {
 public:
  template <typename Look>
  void watch(int milliseconds, Look&& look) {
    for (int i = 0; i < milliseconds; ++i) {
      // About as many as are taken, so that all of them are now and then, and half of them.
      const std::uint32_t count = 900 + random_.below(200);
      for (std::uint32_t n = 0; n < count; ++n) {
        const double x = random_.below(640);
        background.take(x, random_.below(480));
      }
      look();
      time_us += 1'000;
      background.decide(time_us, told ? 1'000 / (640 * 480 * 1e3) : 0);
    }
  }
  void rest(int milliseconds) {
    watch(milliseconds, [] {});
  }
  void turn(int milliseconds) {
    watch(milliseconds, [this] {
      for (int mark = 0; mark < TurningScene::kMarks; ++mark) {
        for (int n = 0; n < 20; ++n) {
          const Pixel at = TurningScene::place(mark, 1e-4 * random_.below(62'832), time_us);
          background.take(std::round(at.x), std::round(at.y));
        }
      }
    });
  }
  // Share of the places between the marks that are taken to stand still.
  double still_share_between() const {
    int still = 0;
    for (int x = 40; x < 600; ++x) still += background.is_still(x, 105);
    return still / 560.0;
  }

  Background background{TurningScene::kSensor, TurningScene::kLeastCells};
  bool told = true;
  std::int64_t time_us = 0;

 private:
  test::RandomNumbers random_;
};

TEST_CASE(
    "Noise that fills the image does not stand still while the head rests, once it is known") {
  NoisyScene scene;
  scene.rest(400);
  for (int i = 0; i < 2'000; ++i) {
    scene.rest(1);
    REQUIRE(scene.background.head_rests());
  }
  CHECK_FALSE(scene.background.is_known());
  CHECK(scene.still_share_between() == 0);
  NoisyScene untold;
  untold.told = false;
  untold.rest(2'400);
  CHECK_FALSE(untold.background.head_rests());
}

TEST_CASE("What stands still is told from noise while the head turns") {
  NoisyScene scene;
  scene.turn(1'000);
  for (int i = 0; i < 1'000; ++i) {
    scene.turn(1);
    REQUIRE(scene.background.head_turns());
  }
  CHECK_FALSE(scene.background.head_rests());
  CHECK(still_share_of_marks(scene.background, scene.time_us) > 0.8);
  CHECK(scene.still_share_between() < 0.05);
}

TEST_CASE("How the scene moves is not known of a head at rest, nor afterwards from before") {
  Background background(TurningScene::kSensor, TurningScene::kLeastCells);
  TurningScene scene;
  scene.show(background, 300);
  REQUIRE(background.still_velocity_at({320, 240}));
  std::int64_t time_us = scene.time_us();
  while (!background.head_rests()) background.decide(time_us += 1'000);
  CHECK_FALSE(background.still_velocity_at({320, 240}));
  // It turns again from where it was.
  scene.wait_until(time_us);
  while (!background.head_turns()) scene.show(background, 1);
  if (const auto velocity = background.still_velocity_at({320, 240})) {
    CHECK(std::abs(velocity->x) < 200);
  }
}

TEST_CASE("A hand with more events than all that stands still does not draw the map along") {
  Background background(TurningScene::kSensor, TurningScene::kLeastCells);
  TurningScene scene;
  scene.show(background, 300);
  // Its edges, 8 px apart, go to the side at 0.7 px a millisecond.
  for (int i = 0; i < 250; ++i) {
    for (int n = 0; n < 3'000; ++n) {
      background.take(std::round(200 + 8 * (n % 12) + 0.7 * i), 150 + n % 150);
    }
    scene.show(background, 1);
    REQUIRE(background.is_known());
    const auto velocity = background.still_velocity_at({320, 240});
    CHECK(velocity.has_value() == background.head_turns());
    // The hand goes at 700 px/s.
    if (velocity) CHECK(std::abs(velocity->x) < 200);
  }
  // So much of what is seen is the hand that it may be all that moves.
  CHECK_FALSE(background.head_turns());
  CHECK(still_share_of_marks(background, scene.time_us()) > 0.9);
}

TEST_CASE("Of too many events some are taken, which say as much") {
  Background background(TurningScene::kSensor, TurningScene::kLeastCells);
  for (int i = 1; i <= 300; ++i) {
    for (int n = 0; n < 20'000; ++n) {
      // Each millisecond's are of other places on the edges, in no order that goes with a stride.
      const int mark = (n + n / TurningScene::kMarks) % TurningScene::kMarks;
      const Pixel at = TurningScene::place(mark, n + i, i * 1'000);
      background.take(std::round(at.x), std::round(at.y));
    }
    background.decide(i * 1'000);
  }
  REQUIRE(background.is_known());
  CHECK(still_share_of_marks(background, 300'000) > 0.9);
}

}  // namespace
}  // namespace puck
