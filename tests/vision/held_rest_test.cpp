#include "common/vision/held_rest.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

// A mallet comes near from one side, or the puck sets off.
constexpr TrackLooks kBeside{.strength = -15, .cover = 0.2, .near_events = 100};
constexpr TrackLooks kSettingOff{.strength = 13, .cover = 0.3, .near_events = 120};

HeldRest resting() {
  HeldRest rest;
  rest.judge({}, true, 100'000);
  return rest;
}

TEST_CASE("Nothing is held that has not rested") {
  HeldRest rest;
  rest.judge(kBeside, false, 100'000);
  CHECK_FALSE(rest.is_held());
}

TEST_CASE("A puck at rest is held for 100 ms while something stirs beside it") {
  HeldRest rest = resting();
  rest.judge(kBeside, false, 150'000);
  CHECK(rest.is_held());
  rest.judge(kBeside, false, 200'000);
  CHECK(rest.is_held());
  rest.judge(kBeside, false, 200'001);
  CHECK_FALSE(rest.is_held());
  CHECK_FALSE(rest.departs());
}

TEST_CASE("It is let go once events lie all around its contour") {
  HeldRest rest = resting();
  TrackLooks one_sided = kSettingOff;
  one_sided.cover = 0.25;
  rest.judge(one_sided, false, 110'000);
  CHECK(rest.is_held());
  rest.judge(kSettingOff, false, 110'500);
  CHECK_FALSE(rest.is_held());
  CHECK(rest.departs());
  rest.judge(kSettingOff, false, 111'000);
  CHECK_FALSE(rest.departs());
}

TEST_CASE("It is let go once something happens inside its contour") {
  HeldRest rest = resting();
  TrackLooks covered = kBeside;
  covered.inside_events = 12;
  rest.judge(covered, false, 110'000);
  CHECK(rest.is_held());
  covered.inside_events = 13;
  rest.judge(covered, false, 110'500);
  CHECK(rest.departs());
}

TEST_CASE("Another track is not held for what the last one did") {
  HeldRest rest = resting();
  rest.forget();
  rest.judge(kBeside, false, 110'000);
  CHECK_FALSE(rest.is_held());
}

}  // namespace
}  // namespace puck
