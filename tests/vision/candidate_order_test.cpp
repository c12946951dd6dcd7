#include "common/vision/candidate_order.h"

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"
#include "tests/vision/turning_scene.h"

namespace puck {
namespace {

using test::TurningScene;

// Its ring is of the marks' own size.
constexpr PuckSizeModel kRoundModel{30, 0, 0, 30, 0, 0};

TEST_CASE("What lies on the background comes last, in the same order otherwise") {
  Background background(TurningScene::kSensor);
  const PuckContour contour(TurningScene::kSensor, kRoundModel, {0, 0, 0}, true);
  TurningScene scene;
  scene.show(background, 300);
  const double sway_px = TurningScene::sway_px(scene.time_us());
  const SearchCandidate mark{{80 + sway_px, 60}, 0.9};
  const SearchCandidate other_mark{{200 + sway_px, 150}, 0.8};
  const SearchCandidate free{{140 + sway_px, 105}, 0.5};
  const SearchCandidate other_free{{260 + sway_px, 105}, 0.4};
  SearchResult found{{}, {}, {mark, other_mark, free, other_free}};
  std::vector<SearchCandidate>& candidates = found.candidates;
  put_still_last(found, background, contour);
  CHECK(candidates[0].score == free.score);
  CHECK(candidates[1].score == other_free.score);
  CHECK(candidates[2].score == mark.score);
  CHECK(candidates[3].score == other_mark.score);

  candidates = {mark, other_mark, free};
  put_still_last(found, background, contour, 0.85);
  CHECK(candidates[0].score == mark.score);
  CHECK(candidates[1].score == free.score);
  CHECK(candidates[2].score == other_mark.score);

  candidates = {mark, free};
  put_still_last(found, Background(TurningScene::kSensor), contour);
  CHECK(candidates[0].score == mark.score);
}

TEST_CASE("A mark taken for a puck of the other wall comes last with the ring of that wall") {
  Background background(TurningScene::kSensor);
  constexpr double kOtherWall = 0.165;
  // Of which the ring without a wall is of the marks' own size.
  const PuckContour contour(TurningScene::kSensor, {30, 0, 0, 30 * (1 + kOtherWall), 0, 0},
                            {0, 0, 0}, true);
  REQUIRE(contour.other_wall_share() == kOtherWall);
  TurningScene scene;
  scene.show(background, 300);
  const double sway_px = TurningScene::sway_px(scene.time_us());
  const SearchCandidate mark{{80 + sway_px, 60 + 30 * kOtherWall / 2}, 0.9};
  const SearchCandidate free{{140 + sway_px, 105}, 0.5};
  SearchResult found{{}, {.other_wall = true}, {mark, free}};
  put_still_last(found, background, contour);
  CHECK(found.candidates[0].score == free.score);
}

TEST_CASE("What has left a trail comes first, in the same order otherwise") {
  const SearchCandidate walker{
      {300, 200}, 0.5, {.sightings = 8, .own_px = 20, .score = 0.5, .rms_px = 0.1}};
  const SearchCandidate other{{100, 100}, 0.9};
  const SearchCandidate another{{500, 300}, 0.8};
  SearchResult found{.candidates = {other, another, walker}};
  put_followed_first(found);
  CHECK(found.candidates[0].position == walker.position);
  CHECK(found.candidates[1].position == other.position);
  CHECK(found.candidates[2].position == another.position);
}

}  // namespace
}  // namespace puck
