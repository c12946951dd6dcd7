#include "common/vision/seen_score.h"

#include <vector>

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

using test::kSensor;

constexpr Pixel kMain{300, 200};
constexpr Region kAround{250, 150, 100, 100};

SearchResult found(const std::vector<SearchCandidate>& candidates, bool other_wall = false,
                   const Region& region = kAround) {
  return {{}, {.region = region, .other_wall = other_wall}, candidates};
}

TEST_CASE("The score is the best that searches have given the track's place") {
  SeenScore score(kSensor);
  CHECK(score.value() == 0);
  score.begin(0.5);
  score.note(found({{{340, 200}, 0.9}, {{302, 201}, 0.6}, {{299, 200}, 0.7}}), kMain, false);
  CHECK(score.value() == 0.7);
  score.begin(0.4);
  CHECK(score.value() == 0.4);
}

TEST_CASE("What searches do not see again is forgotten slowly") {
  SeenScore score(kSensor);
  score.begin(0.7);
  score.note(found({}), kMain, false);
  CHECK(score.value() == doctest::Approx(0.67));
  for (int i = 0; i < 30; ++i) score.note(found({}), kMain, false);
  CHECK(score.value() == 0);
}

TEST_CASE("A search elsewhere says nothing against the track") {
  SeenScore score(kSensor);
  score.begin(0.7);
  score.note(found({}, false, {0, 0, 100, 100}), kMain, false);
  CHECK(score.value() == 0.7);
}

TEST_CASE("A search for a puck of the other side wall says nothing at all") {
  SeenScore score(kSensor);
  score.begin(0.7);
  score.note(found({}, true), kMain, false);
  score.note(found({{kMain, 0.9}}, true), kMain, false);
  CHECK(score.value() == 0.7);
  score.note(found({}, true), kMain, true);
  CHECK(score.value() == doctest::Approx(0.67));
  score.note(found({{kMain, 0.9}}, true), kMain, true);
  CHECK(score.value() == 0.9);
}

TEST_CASE("Beyond the image no search sees the track, and each is a reason to forget") {
  for (const Pixel beyond : {Pixel{-0.5, 200}, {640, 200}, {300, -0.5}, {300, 480}}) {
    CAPTURE(beyond.x);
    CAPTURE(beyond.y);
    SeenScore score(kSensor);
    score.begin(0.7);
    score.note(found({}, false, Region::all_of(kSensor)), beyond, false);
    CHECK(score.value() == doctest::Approx(0.67));
    score.note(found({}), beyond, false);
    CHECK(score.value() == doctest::Approx(0.64));
  }
}

}  // namespace
}  // namespace puck
