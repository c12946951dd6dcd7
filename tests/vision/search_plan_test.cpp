#include "common/vision/search_plan.h"

#include <random>

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

using test::kImage;
using test::kSensor;

constexpr ContourIngredients kAllIngredients{};
constexpr SearchPlan::Situation kCalm{
    .main = {.position = {300, 200}, .quality = 0.9, .strength = 100},
    .is_trusted = true,
    .is_proven = true};

// As many events as a puck makes that moves by a pixel or two.
void stir(SearchPlan& plan) {
  for (int i = 0; i < 100; ++i) plan.take(300 + i % 10, 200 + i / 10);
}

// A second of 10,000 events a second anywhere in the image; how often `decide` got a search for it.
template <typename Decide>
int searches_in_noise(SearchPlan& plan, unsigned seed, std::int64_t from_us, const Decide& decide) {
  std::mt19937 random(seed);
  int searches = 0;
  for (std::int64_t time_us = from_us; time_us < from_us + 1'000'000; time_us += 500) {
    for (int i = 0; i < 5; ++i) {
      plan.take(static_cast<int>(random() % 640), static_cast<int>(random() % 480));
    }
    decide(time_us);
    if (plan.give_out().empty()) continue;
    ++searches;
    plan.note_answer();
  }
  return searches;
}

TEST_CASE("Before anything is known the detection region is searched each 10 ms, one at a time") {
  SearchPlan plan(kSensor, {600, 10, 100, 50});
  stir(plan);
  plan.plan_first(500);
  CHECK(plan.searched_us(1'500) == 1'000);
  CHECK(plan.give_out() == Region{600, 10, 40, 50});
  CHECK(plan.give_out().empty());
  plan.plan_first(30'000);
  CHECK(plan.give_out().empty());
  plan.note_answer();
  plan.plan_first(10'499);
  CHECK(plan.give_out().empty());
  plan.plan_first(10'500);
  CHECK_FALSE(plan.give_out().empty());
  CHECK(plan.searched_us(11'500) == 11'000);
}

TEST_CASE("What is searched is known from when it is wanted until the answer has come") {
  SearchPlan plan(kSensor, {100, 100, 200, 80});
  CHECK(plan.searched().empty());
  plan.plan_first(0);
  CHECK(plan.searched() == Region{100, 100, 200, 80});
  plan.give_out();
  CHECK(plan.searched() == Region{100, 100, 200, 80});
  plan.note_answer();
  CHECK(plan.searched().empty());
}

TEST_CASE("Without a detection region the search is everywhere") {
  SearchPlan plan(kSensor, {});
  plan.plan_first(0);
  CHECK(plan.give_out() == kImage);
}

TEST_CASE("The better the track, the more seldom the whole image is searched") {
  constexpr bool kStirs = false;
  constexpr bool kIsStill = true;
  SearchPlan::Situation now = kCalm;
  CHECK(SearchPlan::usual_period_us(now, kStirs) == 500'000);
  now.main.strength = 301;
  CHECK(SearchPlan::usual_period_us(now, kStirs) == SearchPlan::kNever_us);
  // A round mark may be as strong.
  now.is_proven = false;
  CHECK(SearchPlan::usual_period_us(now, kStirs) == 40'000);
  now.is_proven = true;
  now.main.quality = 0.84;
  CHECK(SearchPlan::usual_period_us(now, kStirs) == 40'000);
  now.main.quality = 0.86;
  now.is_trusted = false;
  CHECK(SearchPlan::usual_period_us(now, kStirs) == 40'000);
  now.is_resting = true;
  CHECK(SearchPlan::usual_period_us(now, kStirs) == 1'000'000);
  now.may_rest_elsewhere = true;
  CHECK(SearchPlan::usual_period_us(now, kStirs) == 50'000);
  CHECK(SearchPlan::usual_period_us(now, kIsStill) == 1'000'000);
  now.is_lost = true;
  CHECK(SearchPlan::usual_period_us(now, kStirs) == 10'000);
}

TEST_CASE("What is lost for 100 ms, or unsound for so long, may be anywhere") {
  SearchPlan::Situation now = kCalm;
  now.unsound_us = 100'000;
  CHECK_FALSE(SearchPlan::may_be_anywhere(now));
  now.unsound_us = 100'001;
  CHECK(SearchPlan::may_be_anywhere(now));
  now.may_be_faint = true;
  CHECK_FALSE(SearchPlan::may_be_anywhere(now));
  now.may_be_faint = false;
  now.is_resting = true;
  CHECK_FALSE(SearchPlan::may_be_anywhere(now));
  now.is_lost = true;
  CHECK_FALSE(SearchPlan::may_be_anywhere(now));
  now.since_good_us = 100'001;
  CHECK(SearchPlan::may_be_anywhere(now));
}

TEST_CASE("What may be anywhere is searched for everywhere each 5 ms, and not near the track") {
  SearchPlan::Situation now = kCalm;
  now.main.quality = 0.59;
  now.unsound_us = 100'001;
  SearchPlan plan(kSensor, {});
  for (int i = 0; i < 60; ++i) plan.take(10, 10);
  plan.plan(now, kAllIngredients, 5'000);
  CHECK(plan.give_out() == kImage);
  plan.note_answer();
  plan.plan(now, kAllIngredients, 9'999);
  CHECK(plan.give_out().empty());
  plan.plan(now, kAllIngredients, 10'000);
  CHECK(plan.give_out() == kImage);
  plan.note_answer();
  // Of what has not stirred for 100 ms nothing could be found.
  plan.plan(now, kAllIngredients, 105'001);
  CHECK(plan.give_out().empty());

  for (const auto& ingredient : {&ContourIngredients::anywhere, &ContourIngredients::wide_search}) {
    ContourIngredients without = kAllIngredients;
    without.*ingredient = false;
    SearchPlan near(kSensor, {});
    near.plan(now, without, 5'000);
    CHECK(near.give_out() == Region{280, 180, 41, 41});
  }
}

TEST_CASE("A calm track is left in peace until the whole image is due") {
  SearchPlan plan(kSensor, {});
  plan.plan(kCalm, kAllIngredients, 499'999);
  CHECK(plan.give_out().empty());
  plan.plan(kCalm, kAllIngredients, 500'000);
  CHECK(plan.give_out() == kImage);
}

TEST_CASE("Near a doubtful track is searched each 5 ms, the farther the longer it was not good") {
  SearchPlan plan(kSensor, {});
  SearchPlan::Situation now = kCalm;
  now.main.quality = 0.59;
  plan.plan(now, kAllIngredients, 5'000);
  CHECK(plan.give_out() == Region{280, 180, 41, 41});
  plan.note_answer();
  plan.plan(now, kAllIngredients, 9'999);
  CHECK(plan.give_out().empty());
  now.since_good_us = 10'000;
  plan.plan(now, kAllIngredients, 10'000);
  CHECK(plan.give_out() == Region{265, 165, 71, 71});
  plan.note_answer();
  now.is_resting = true;
  plan.plan(now, kAllIngredients, 20'000);
  CHECK(plan.give_out().empty());
}

TEST_CASE(
    "While there is nothing but noise a search is made once a second, without a track or lost") {
  SearchPlan::Situation lost = kCalm;
  lost.is_lost = true;
  lost.main.quality = 0;
  for (const unsigned seed : {1u, 2u, 3u}) {
    CAPTURE(seed);
    SearchPlan first(kSensor, {});
    CHECK(searches_in_noise(first, seed, 0, [&](auto now_us) { first.plan_first(now_us); }) == 1);
    SearchPlan plan(kSensor, {});
    CHECK(searches_in_noise(plan, seed, 100'000,
                            [&](auto now_us) { plan.plan(lost, kAllIngredients, now_us); }) == 1);
  }
}

TEST_CASE("What may be a faint puck at rest is looked for elsewhere while something stirs") {
  SearchPlan plan(kSensor, {});
  SearchPlan::Situation now = kCalm;
  now.is_resting = true;
  now.may_rest_elsewhere = true;
  const auto decide = [&](std::int64_t time_us) { plan.plan(now, kAllIngredients, time_us); };
  CHECK(searches_in_noise(plan, 1, 1'000'500, decide) == 1);
  const auto stir_and_decide = [&](std::int64_t time_us) {
    if (time_us % 50'000 == 0) stir(plan);
    decide(time_us);
  };
  CHECK(searches_in_noise(plan, 2, 2'000'500, stir_and_decide) == 20);
  // The last one is remembered for 100 ms.
  CHECK(searches_in_noise(plan, 3, 3'000'500, decide) == 2);
}

TEST_CASE("What moves is searched for at once, however long nothing has moved") {
  SearchPlan plan(kSensor, {});
  const auto decide = [&](std::int64_t time_us) { plan.plan_first(time_us); };
  searches_in_noise(plan, 1, 0, decide);
  CHECK(plan.is_still(999'500));
  stir(plan);
  plan.plan_first(1'000'500);
  CHECK_FALSE(plan.is_still(1'000'500));
  CHECK(plan.give_out() == kImage);
  plan.note_answer();
  plan.plan_first(1'020'500);
  CHECK(plan.give_out() == kImage);
}

TEST_CASE("Each of the two searches can be switched off") {
  SearchPlan plan(kSensor, {});
  SearchPlan::Situation now = kCalm;
  now.main.quality = 0.2;
  plan.plan(now, {.search = false, .wide_search = false}, 1'000'000);
  CHECK(plan.give_out().empty());
  plan.plan(now, {.wide_search = false}, 1'000'000);
  CHECK(plan.give_out() == Region{280, 180, 41, 41});
  plan.note_answer();
  plan.plan(now, {.search = false}, 1'000'000);
  CHECK(plan.give_out() == kImage);
}

}  // namespace
}  // namespace puck
