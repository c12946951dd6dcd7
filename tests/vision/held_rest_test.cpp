#include "common/vision/held_rest.h"

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

using test::sound;

// A mallet comes near from one side, or the puck sets off.
constexpr TrackLooks kBeside{.strength = -15, .cover = 0.2, .near_events = 100};
constexpr TrackLooks kSettingOff{.strength = 13, .cover = 0.3, .near_events = 120};

constexpr TrackLooks kGood{.speed_px_s = 500, .quality = 0.9, .strength = 50, .near_events = 60};

// Of a track that was good, and 0.5 ms later too, or is silent.
TrackStanding standing(bool rests) {
  TrackStanding made({640, 480}, 50'000);
  made.judge(kGood, true, false, sound(), 100'000);
  made.judge(rests ? TrackLooks{} : kGood, true, false, sound(), 100'500);
  return made;
}

// Of a puck that makes so many events at each pixel.
PuckSignature signature(int events_each) {
  PuckSignature::Sample sample;
  for (int i = 0; i < 100 * events_each; ++i) sample.count(true, 500, i % events_each == 0);
  PuckSignature made;
  made.learn(sample, 1'000);
  return made;
}

HeldRest resting() {
  HeldRest rest;
  rest.judge({}, true, 100'000);
  return rest;
}

TEST_CASE("What rests may be held, but not what moves") {
  REQUIRE(standing(true).is_resting());
  REQUIRE(standing(true).state() == TrackState::kTracking);
  CHECK(may_hold(standing(true), signature(5)));
  REQUIRE(standing(false).state() == TrackState::kTracking);
  CHECK_FALSE(may_hold(standing(false), signature(5)));
}

TEST_CASE("A faint puck is not held, since it is quiet while it moves") {
  REQUIRE(signature(1).is_faint());
  CHECK_FALSE(may_hold(standing(true), signature(1)));
  CHECK_FALSE(may_hold(standing(false), signature(1)));
}

TEST_CASE("What rests is not held while the puck is lost, since it may be gone") {
  TrackStanding lost({640, 480}, 50'000);
  lost.judge({}, true, false, sound(), 100'000);
  REQUIRE(lost.is_resting());
  REQUIRE(lost.state() == TrackState::kLost);
  CHECK_FALSE(may_hold(lost, signature(5)));
  CHECK_FALSE(may_hold(lost, signature(1)));
  lost.judge(kBeside, true, false, sound(), 100'500);
  REQUIRE_FALSE(lost.is_resting());
  CHECK_FALSE(may_hold(lost, signature(5)));
}

TEST_CASE("What is brought back to rest is held at once, for 100 ms") {
  HeldRest rest;
  rest.seize(test::contour_context(), 100'000);
  CHECK(rest.is_held());
  rest.judge(kBeside, false, 200'000);
  CHECK(rest.is_held());
  rest.judge(kBeside, false, 200'500);
  CHECK_FALSE(rest.is_held());
}

TEST_CASE(
    "With holding switched off what is brought back is not held, as nothing would let it go") {
  HeldRest rest;
  ContourContext context = test::contour_context();
  context.ingredients.holding = false;
  rest.seize(context, 100'000);
  CHECK_FALSE(rest.is_held());
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
  CHECK_FALSE(rest.sets_off());
}

TEST_CASE("It is let go once events lie all around its contour") {
  HeldRest rest = resting();
  TrackLooks one_sided = kSettingOff;
  one_sided.cover = 0.25;
  rest.judge(one_sided, false, 110'000);
  CHECK(rest.is_held());
  rest.judge(kSettingOff, false, 110'500);
  CHECK_FALSE(rest.is_held());
  CHECK(rest.sets_off());
  rest.judge(kSettingOff, false, 111'000);
  CHECK_FALSE(rest.sets_off());
}

TEST_CASE("It is let go once something is on it, but does not set off for that") {
  HeldRest rest = resting();
  TrackLooks covered = kBeside;
  covered.inside_events = 12;
  rest.judge(covered, false, 110'000);
  CHECK(rest.is_held());
  covered.inside_events = 13;
  rest.judge(covered, false, 110'500);
  CHECK_FALSE(rest.is_held());
  CHECK_FALSE(rest.sets_off());
}

TEST_CASE("Another track is not held for what the last one did") {
  HeldRest rest = resting();
  rest.forget();
  rest.judge(kBeside, false, 110'000);
  CHECK_FALSE(rest.is_held());
}

}  // namespace
}  // namespace puck
