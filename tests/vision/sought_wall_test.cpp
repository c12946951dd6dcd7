#include "common/vision/sought_wall.h"

#include <string>

#include <doctest/doctest.h>

namespace puck {
namespace {

// Of the next eight searches: o for the other wall, c for the calibrated one.
std::string next_eight(SoughtWall& wall, const SoughtWall::Situation& now) {
  std::string sought;
  for (int i = 0; i < 8; ++i) sought += wall.next(now) ? 'o' : 'c';
  return sought;
}

}  // namespace

TEST_CASE("until a track has shown the puck's wall both are looked for, but the other one later") {
  SoughtWall wall;
  CHECK(next_eight(wall, {.is_early = true, .may_be_faint = true}) == "cccccccc");
  CHECK(next_eight(wall, {}) == "cocococo");
  CHECK(wall.is_conjecture());
}

TEST_CASE("what a track has shown of the wall is looked for") {
  SoughtWall wall;
  wall.learn(true, 1);
  CHECK(next_eight(wall, {.is_trusted = true}) == "oooooooo");
  CHECK_FALSE(wall.is_conjecture());
  wall.learn(false, 500'000);
  CHECK(next_eight(wall, {.is_trusted = true, .may_be_faint = true}) == "cccccccc");
  CHECK(wall.is_conjecture());
}

TEST_CASE("what the wall was for longer of late counts, and no more than half a second of it") {
  SoughtWall wall;
  wall.learn(true, 3'000'000);
  wall.learn(false, 499'999);
  CHECK_FALSE(wall.is_conjecture());
  wall.learn(false, 1);
  CHECK(wall.is_conjecture());
  wall.learn(true, 1);
  CHECK_FALSE(wall.is_conjecture());
}

TEST_CASE("what was learned of the wall is doubted when no track is trusted any more") {
  SoughtWall wall;
  wall.learn(true, 1);
  CHECK(next_eight(wall, {}) == "ooocoooc");
  wall.learn(false, 500'000);
  CHECK(next_eight(wall, {.may_be_faint = true}) == "cccoccco");
  // The wall of a puck that is not faint makes events.
  CHECK(next_eight(wall, {}) == "cccccccc");
}

}  // namespace puck
