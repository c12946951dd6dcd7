#include "common/vision/wall_height.h"

#include <cmath>
#include <cstdint>
#include <optional>

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"
#include "tests/vision/moving_contour.h"
#include "tests/vision/random_numbers.h"

namespace puck {
namespace {

using test::kSensor;

// Seen from 30° above, and annotated by its face.
PuckSizeModel face_model() {
  PuckSizeModel model{16, 0, 0.08, 8, 0, 0.08};
  model.disc = DiscModel{.width_0 = 12,
                         .width_y = 0.075,
                         .face_on_px = 60,
                         .principal_x_px = 320,
                         .principal_y_px = 240};
  return model;
}

// What is learned of a puck from what it makes when it glides by.
class Watched {
 public:
  // `wall`: how high it is, in widths, in the image's middle. `grown_px`: by how much the puck is
  // larger all round than the model.
  explicit Watched(double wall, double grown_px = 0, double calibrated = 0)
      : truth_(kSensor, face_model(), {0, 0, 2 * grown_px}, true),
        context_{PuckContour(kSensor, face_model(), {0, calibrated, 0}, true), {}, {}, {}} {
    truth_.correct_other_wall_share(-wall);
  }

  void glide(Pixel start, PixelVelocity velocity, int milliseconds) {
    test::MovingContour face(truth_, start, velocity, density, 0);
    test::MovingContour whole(truth_, start, velocity, density, truth_.other_wall_share());
    for (int i = 0; i < 2 * milliseconds; ++i) {
      const std::int64_t time_us = i * std::int64_t{500};
      const Pixel puck = face.position_at(time_us);
      ContourFilter::Start place;
      place.position = {puck.x, puck.y + track_low_px};
      place.velocity = velocity;
      const ContourTrack track(context_, place, time_us, 0);
      height.watch(is_known ? &track : nullptr, context_.contour, 500);
      if (shows_face) show(face, time_us);
      if (shows_whole) show(whole, time_us);
      for (int n = 0; n < clutter; ++n) {
        height.take(
            {time_us, puck.x - 30.0 + random_.below(60), puck.y - 30.0 + random_.below(60)});
      }
    }
  }

  WallHeight height;
  double density = 3;       // events on each px² that an edge sweeps
  bool is_known = true;     // beyond doubt the puck's
  bool shows_face = false;  // all of its edge, where the wall has another tone
  bool shows_whole = true;  // the silhouette
  int clutter = 0;          // events anywhere near the puck in each half millisecond
  double track_low_px = 0;  // by how much the track is too low

 private:
  void show(test::MovingContour& contour, std::int64_t from_us) {
    for (const ContourEvent& event : contour.events(from_us, from_us + 500)) height.take(event);
  }

  PuckContour truth_;
  ContourContext context_;
  test::RandomNumbers random_;
};

TEST_CASE("The height of the puck's wall is learned wherever it is seen, and however it moves") {
  for (const double wall : {0.13, 0.2, 0.3, 0.4}) {
    for (const Pixel start : {Pixel{120, 140}, {320, 240}, {520, 380}}) {
      for (const PixelVelocity velocity :
           {PixelVelocity{0, 200}, {0, -200}, {500, 150}, {-500, 150}}) {
        CAPTURE(wall);
        CAPTURE(start.y);
        CAPTURE(velocity.x);
        CAPTURE(velocity.y);
        Watched puck(wall);
        puck.glide(start, velocity, 150);
        REQUIRE(puck.height.share());
        CHECK(std::abs(*puck.height.share() - wall) < 0.02);
      }
    }
  }
}

TEST_CASE("An edge between face and wall and clutter do not hide how high a wall is") {
  Watched puck(0.25);
  puck.shows_face = true;
  puck.clutter = 4;
  puck.glide({320, 200}, {100, 250}, 200);
  REQUIRE(puck.height.share());
  CHECK(std::abs(*puck.height.share() - 0.25) < 0.02);
}

TEST_CASE("A track that is too low or too high, and a puck of another size, do not mislead") {
  struct Case {
    double off_px;
    double grown_px;
  };
  for (const Case& now : {Case{-0.7, 0}, {0.7, 0}, {0, 0.5}, {0.4, -0.4}}) {
    const double off_px = now.off_px;
    const double grown_px = now.grown_px;
    CAPTURE(off_px);
    CAPTURE(grown_px);
    Watched puck(0.25, grown_px);
    puck.track_low_px = off_px;
    puck.glide({320, 240}, {200, 300}, 200);
    REQUIRE(puck.height.share());
    CHECK(std::abs(*puck.height.share() - 0.25) < 0.015);
  }
}

TEST_CASE("The share that was calibrated does not change what is learned of the wall") {
  for (const double calibrated : {-0.04, 0.04}) {
    CAPTURE(calibrated);
    Watched puck(0.25, 0, calibrated);
    puck.glide({320, 240}, {200, 300}, 200);
    REQUIRE(puck.height.share());
    CHECK(std::abs(*puck.height.share() - 0.25) < 0.015);
  }
}

TEST_CASE("Of a puck whose wall makes no events, and of clutter alone, no height is learned") {
  Watched puck(0.25);
  puck.shows_whole = false;
  SUBCASE("no wall") { puck.shows_face = true; }
  SUBCASE("clutter") { puck.clutter = 30; }
  puck.glide({320, 150}, {100, 250}, 400);
  CHECK_FALSE(puck.height.share());
}

TEST_CASE("Only a track beyond doubt, large enough and moving up or down, shows the wall") {
  Watched puck(0.25);
  Pixel start{320, 240};
  PixelVelocity velocity{0, 300};
  SUBCASE("in doubt") { puck.is_known = false; }
  SUBCASE("too small") {
    start = {320, 40};
    velocity = {0, -200};
  }
  SUBCASE("to the side") { velocity = {300, 60}; }
  puck.glide(start, velocity, 100);
  CHECK_FALSE(puck.height.share());
}

TEST_CASE("A few events are not enough to learn a wall's height from, and what is learned fades") {
  Watched puck(0.2);
  puck.density = 0.1;
  puck.glide({320, 240}, {0, 300}, 20);
  CHECK_FALSE(puck.height.share());
  puck.density = 3;
  puck.glide({320, 240}, {0, 300}, 100);
  CHECK(puck.height.share());
  puck.shows_whole = false;
  puck.glide({320, 240}, {0, 100}, 2'000);
  puck.glide({320, 240}, {0, 100}, 2'000);
  CHECK_FALSE(puck.height.share());
}

}  // namespace
}  // namespace puck
