#include "common/vision/challengers.h"

#include <algorithm>

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"
#include "tests/vision/sighting_walk.h"

namespace puck {
namespace {

using Kind = Challenger::Kind;
using test::kContext;

constexpr ContourFilter::Start kStart{.position = {300, 200}};
constexpr std::int64_t kPeriod_us = 500;

void find(Challengers& challengers, const std::vector<SearchCandidate>& candidates,
          std::int64_t time_us = 0) {
  challengers.add_found({.result = {{time_us}, {}, candidates},
                         .main = Pixel{600, 400},
                         .time_us = time_us,
                         .period_us = kPeriod_us},
                        kContext);
}

TEST_CASE("There are at most so many challengers of each kind") {
  Challengers challengers;
  for (int i = 0; i < 50; ++i) challengers.add(Kind::kTwin, kContext, kStart, 0, 0);
  CHECK(test::count(challengers) == 4);
  for (int i = 0; i < 50; ++i) challengers.add(Kind::kWitness, kContext, kStart, 0, 0);
  CHECK(test::count(challengers) == 4 + 8);
  for (int i = 0; i < 50; ++i) challengers.add(Kind::kWall, kContext, kStart, 0, 0);
  CHECK(test::count(challengers) == 4 + 8 + 1);
  for (int i = 0; i < 50; ++i) challengers.add(Kind::kSearch, kContext, kStart, 0, 0);
  CHECK(test::count(challengers) == 4 + 8 + 1 + 36);
}

TEST_CASE("What is found is tried with both opinions on the wall, on the same ring") {
  Challengers challengers;
  find(challengers, {{{300, 200}, 0.5}});
  REQUIRE(test::count(challengers) == 2);
  const ContourTrack& first = challengers.begin()->track();
  const ContourTrack& second = std::next(challengers.begin())->track();
  CHECK(first.wall_share() == kContext.contour.calibrated_wall_share());
  CHECK(second.wall_share() == kContext.contour.other_wall_share());
  CHECK(first.wall_share() != second.wall_share());
  CHECK(first.filter().position() == Pixel{300, 200});
  CHECK(second.filter().position() ==
        kContext.contour.centre_with_wall({300, 200}, first.wall_share(), second.wall_share()));

  ContourContext plain = kContext;
  plain.ingredients.wall = false;
  Challengers of_one_opinion;
  of_one_opinion.add_found({.result = {{}, {}, {{{300, 200}, 0.5}}}, .period_us = kPeriod_us},
                           plain);
  CHECK(test::count(of_one_opinion) == 1);
}

TEST_CASE("What is found again, or is the main track, is not tried") {
  Challengers challengers;
  find(challengers, {{{300, 200}, 0.5}});
  find(challengers, {{{303, 200}, 0.5}, {{601, 400}, 0.5}});
  CHECK(test::count(challengers) == 2);
  find(challengers, {{{250, 200}, 0.5}, {{603, 400}, 0.5}});
  CHECK(test::count(challengers) == 6);
}

TEST_CASE(
    "A challenger of the main track's place, motion and size is dropped, of another size not") {
  const auto left_beside = [](double growth_px) {
    Challengers challengers;
    challengers.add(Kind::kSearch, kContext, kStart, 0, 0);
    ContourFilter::Start start = kStart;
    start.growth_px = growth_px;
    challengers.dismiss_idle(ContourFilter({}, start, 0), 1'000);
    return test::count(challengers);
  };
  CHECK(left_beside(0) == 0);
  CHECK(left_beside(0.29) == 0);
  CHECK(left_beside(0.31) == 1);
  CHECK(left_beside(-0.31) == 1);
}

// A search is made at 2 ms; its answer comes at 12 ms.
TEST_CASE("What a search found catches up on what has happened since its snapshot, to the bit") {
  constexpr std::int64_t kSeen_us = 2'000;
  constexpr std::int64_t kNow_us = 12'000;
  test::MovingContour puck(kContext.contour, {300, 200}, {1500, 200});
  const Pixel seen_at = puck.position_at(kSeen_us);
  MissedEvents missed;
  missed.begin(Region::all_of(test::kSensor));
  Challengers in_time;
  for (std::int64_t t = 0; t < kNow_us; t += kPeriod_us) {
    if (t == kSeen_us) find(in_time, {{seen_at, 0.5}}, kSeen_us);
    for (const ContourEvent& event : puck.events(t + 1, t + kPeriod_us + 1)) {
      missed.take(event, 0.25);
      in_time.take(event, 0.25, kContext);
    }
    in_time.decide(t + kPeriod_us, kContext);
  }

  Challengers late;
  const SearchResult result{{kSeen_us}, {}, {{seen_at, 0.5}}};
  const Challengers::Answer answer{.result = result,
                                   .missed = missed.events(),
                                   .time_us = kNow_us,
                                   .period_us = kPeriod_us,
                                   .decided_us = kNow_us};
  late.add_found(answer, kContext);
  REQUIRE(test::count(late) == 2);
  const ContourTrack& track = late.begin()->track();
  CHECK(distance_px(track.filter().position(), puck.position_at(kNow_us)) < 1);
  CHECK(track.filter().position() == in_time.begin()->track().filter().position());
  CHECK(track.quality() == in_time.begin()->track().quality());
  CHECK(track.quality() > 0.7);
  CHECK(late.begin()->age_us(kNow_us) == kNow_us - kSeen_us);
  CHECK(late.begin()->leads() == in_time.begin()->leads());

  // It is known where the puck was then, not only where it is now.
  late.add_found(answer, kContext);
  CHECK(test::count(late) == 2);
}

// What has happened since a search at 0, and an answer so late.
Challengers found_late(const std::vector<ContourEvent>& events, std::int64_t late_us,
                       bool can_catch_up = true) {
  MissedEvents missed;
  missed.begin(Region::all_of(test::kSensor));
  for (const ContourEvent& event : events) missed.take(event, 0);
  const SearchResult result{{0}, {}, {{{300, 200}, 0.5}}};
  Challengers challengers;
  challengers.add_found({.result = result,
                         .missed = missed.events(),
                         .can_catch_up = can_catch_up,
                         .time_us = late_us,
                         .period_us = kPeriod_us,
                         .decided_us = late_us},
                        kContext);
  REQUIRE(test::count(challengers) == 2);
  return challengers;
}

TEST_CASE("What was found late is tried for as long as what was found at once") {
  test::MovingContour puck(kContext.contour, {300, 200}, {300, 0});
  constexpr std::int64_t kLate_us = 200'000;
  Challengers challengers = found_late(puck.events(1, 20'000), kLate_us);
  CHECK(challengers.begin()->age_us(kLate_us) == kLate_us);
  const ContourFilter far({}, {.position = {100, 400}}, 0);
  challengers.dismiss_idle(far, kLate_us + 60'000);
  CHECK(test::count(challengers) == 2);
  challengers.dismiss_hopeless(kLate_us + 10'000, true);
  CHECK(test::count(challengers) == 2);
  challengers.dismiss_idle(far, kLate_us + 60'001);
  CHECK(test::count(challengers) == 0);
}

TEST_CASE("To catch up takes as long as there are events, however late it is") {
  const Challengers challengers = found_late({}, 1'000'000'000'000'000);
  CHECK(challengers.begin()->track().quality() == 0);
}

TEST_CASE("What stands still does not help to catch up either") {
  test::MovingContour puck(kContext.contour, {300, 200}, {700, 200});
  std::vector<ContourEvent> events = puck.events(1, 5'001);
  CHECK(found_late(events, 5'000).begin()->track().looks().near_events > 10);
  for (ContourEvent& event : events) event.still = true;
  CHECK(found_late(events, 5'000).begin()->track().looks().near_events == 0);
}

TEST_CASE("What cannot catch up is tried from now on") {
  const Challengers challengers = found_late({}, 5'000, false);
  CHECK(challengers.begin()->age_us(6'000) == 1'000);
}

TEST_CASE("What no event speaks for is refuted, and not tried again for a while") {
  Challengers challengers;
  find(challengers, {{{300, 200}, 0.5}});
  challengers.add(Kind::kWitness, kContext, kStart, 0, 0);
  challengers.dismiss_hopeless(10'000, true);
  CHECK(test::count(challengers) == 3);
  challengers.dismiss_hopeless(10'001, true);
  CHECK(test::count(challengers) == 1);
  find(challengers, {{{300, 200}, 0.5}}, 20'000);
  CHECK(test::count(challengers) == 1);
  find(challengers, {{{300, 200}, 0.5}}, 120'000);
  CHECK(test::count(challengers) == 3);
}

TEST_CASE("What looks clearly better than what was refuted there is tried at once") {
  Challengers challengers;
  find(challengers, {{{300, 200}, 0.5}});
  challengers.dismiss_hopeless(10'001, true);
  find(challengers, {{{300, 200}, 0.55}}, 20'000);
  CHECK(test::count(challengers) == 0);
  find(challengers, {{{300, 200}, 0.7}}, 20'000);
  CHECK(test::count(challengers) == 2);
}

TEST_CASE("Where an edge that passed has left what it led away, the next find is tried at once") {
  const auto tried = [](bool head_rests) {
    Challengers challengers;
    find(challengers, {{{300, 200}, 0.5}});
    for (std::int64_t t = 0; t < 26'000; t += 500) {
      for (int y = 190; y < 210; ++y) {
        challengers.take({t, 300 + 1e-3 * static_cast<double>(t), y + 0.0, false, true}, 0,
                         kContext);
      }
      challengers.decide(t + 500, kContext);
    }
    for (const Challenger& challenger : challengers) REQUIRE(challenger.track().looks().is_fast());
    const Pixel left = challengers.begin()->track().filter().position();
    challengers.dismiss_hopeless(26'000, head_rests);
    REQUIRE(test::count(challengers) == 0);
    find(challengers, {{left, 0.5}}, 26'000);
    return test::count(challengers);
  };
  CHECK(tried(true) == 2);
  CHECK(tried(false) == 0);
}

TEST_CASE("What is found again has the highest of its scores") {
  Challengers challengers;
  find(challengers, {{{300, 200}, 0.5}});
  find(challengers, {{{301, 200}, 0.7}});
  find(challengers, {{{300, 200}, 0.6}});
  REQUIRE(test::count(challengers) == 2);
  for (const Challenger& challenger : challengers) CHECK(challenger.found().score == 0.7);
}

TEST_CASE("What is found again by more than a conjecture is no longer one, and has that score") {
  Challengers challengers;
  const auto find_other_wall = [&](double score, bool is_conjecture) {
    const SearchRequest request{.other_wall = true};
    challengers.add_found({.result = {{}, request, {{{300, 200}, score}}},
                           .is_conjecture = is_conjecture,
                           .period_us = kPeriod_us},
                          kContext);
    REQUIRE(test::count(challengers) == 2);
    return challengers.begin()->found();
  };
  CHECK(find_other_wall(0.8, true).is_conjecture);
  CHECK(challengers.begin()->track().wall_share() == kContext.contour.other_wall_share());
  const Challenger::Found found = find_other_wall(0.5, false);
  CHECK_FALSE(found.is_conjecture);
  CHECK(found.score == 0.5);
  CHECK(find_other_wall(0.9, true).score == 0.5);
}

TEST_CASE("What has left a steady trail starts as fast as that, even where something was refuted") {
  SightingTrails trails;
  const SearchResult walked =
      test::show(trails, {.end = {300, 200}, .velocity = {500, 0}, .searches = 8}, kContext.contour,
                 1'000'000);
  Challengers challengers;
  SearchResult without = walked;
  without.candidates.front().trail = {};
  const auto find_walker = [&](const SearchResult& found) {
    challengers.add_found(
        {.result = found, .main = Pixel{600, 400}, .time_us = 1'000'000, .period_us = kPeriod_us},
        kContext);
  };
  find_walker(without);
  REQUIRE(test::count(challengers) == 2);
  CHECK(challengers.begin()->track().filter().velocity().x == 0);
  CHECK(challengers.begin()->found().trail.sightings == 0);
  challengers.dismiss_hopeless(1'000'000 + 11'000, false);
  REQUIRE(test::count(challengers) == 0);
  find_walker(without);
  CHECK(test::count(challengers) == 0);
  find_walker(walked);
  REQUIRE(test::count(challengers) == 2);
  CHECK(challengers.begin()->track().filter().velocity().x == doctest::Approx(500));
  CHECK(challengers.begin()->found().trail.sightings == 8);
}

TEST_CASE("What is found again has the trail of then") {
  Challengers challengers;
  SightingTrails trails;
  for (int i = 0; i < 3; ++i) {
    SearchResult found{{5'000 * (i + 1)},
                       {.region = Region::all_of(test::kSensor)},
                       {{{300.0 + i, 200}, 0.5 - 0.1 * i}}};
    trails.take(found, kContext.contour, Background(test::kSensor), true);
    challengers.add_found({.result = found, .time_us = found.time.us, .period_us = kPeriod_us},
                          kContext);
    CHECK(test::count(challengers) == 2);
    CHECK(challengers.begin()->found().trail.sightings == i + 1);
    CHECK(challengers.begin()->found().score == 0.5);
  }
}

TEST_CASE("Those born of the main track go with it, those that were found stay") {
  Challengers challengers;
  find(challengers, {{{300, 200}, 0.5}});
  challengers.add(Kind::kTwin, kContext, kStart, 0, 0);
  challengers.add(Kind::kWitness, kContext, kStart, 0, 0);
  challengers.add(Kind::kWall, kContext, kStart, 0, 0);
  challengers.dismiss_born();
  REQUIRE(test::count(challengers) == 2);
  CHECK(challengers.begin()->kind() == Kind::kSearch);
}

TEST_CASE("What stands still speaks for nothing that was found") {
  Challengers challengers;
  find(challengers, {{{300, 200}, 0.5}});
  test::MovingContour puck(kContext.contour, {300, 200}, {700, 200});
  for (ContourEvent event : puck.events(0, 5'000)) {
    event.still = true;
    challengers.take(event, 0, kContext);
  }
  challengers.decide(5'000, kContext);
  CHECK(challengers.begin()->track().looks().near_events == 0);
}

TEST_CASE("What is evident takes the place of the least likely") {
  Challengers challengers;
  for (int i = 0; i < 18; ++i) find(challengers, {{{20.0 + 20 * i, 100}, 0.3 + 0.01 * i}});
  CHECK(test::count(challengers) == 36);
  find(challengers, {{{300, 300}, 0.6}});
  find(challengers, {{{300, 400}, 0.7}});
  CHECK(test::count(challengers) == 36);
  const auto has = [&](double score) {
    return std::count_if(challengers.begin(), challengers.end(),
                         [&](const Challenger& one) { return one.found().score == score; });
  };
  CHECK(has(0.3) == 0);
  CHECK(has(0.31) == 2);
  CHECK(has(0.6) == 0);
  CHECK(has(0.7) == 2);
}

TEST_CASE("Where there is no room, what no event has spoken for within 5 ms gives way") {
  Challengers challengers;
  for (int i = 0; i < 18; ++i) find(challengers, {{{20.0 + 20 * i, 100}, 0.5}});
  const auto is_tried = [&](double score) {
    return std::any_of(challengers.begin(), challengers.end(),
                       [&](const Challenger& one) { return one.found().score == score; });
  };
  find(challengers, {{{300, 300}, 0.3}}, 4'999);
  CHECK_FALSE(is_tried(0.3));
  find(challengers, {{{300, 300}, 0.4}}, 5'000);
  CHECK(is_tried(0.4));
  CHECK(test::count(challengers) == 36);

  // What events speak for keeps its place.
  challengers.clear();
  std::vector<test::MovingContour> pucks;
  for (int i = 0; i < 18; ++i) {
    const Pixel place{20.0 + 30 * i, 100};
    find(challengers, {{place, 0.5}});
    pucks.emplace_back(kContext.contour, place, PixelVelocity{0, 300});
  }
  for (test::MovingContour& puck : pucks) {
    for (const ContourEvent& event : puck.events(0, 5'000)) challengers.take(event, 0, kContext);
  }
  challengers.decide(5'000, kContext);
  find(challengers, {{{300, 300}, 0.4}}, 5'000);
  CHECK_FALSE(is_tried(0.4));
  CHECK(test::count(challengers) == 36);
}

TEST_CASE("Challengers that are too old or the same as the main track are given up") {
  Challengers challengers;
  challengers.add(Kind::kTwin, kContext, kStart, 0, 0);
  challengers.add(Kind::kWall, kContext, kStart, 0, 0);
  const ContourFilter far({}, {.position = {310, 200}}, 0);
  challengers.dismiss_idle(far, 8'000);
  CHECK(test::count(challengers) == 2);
  challengers.dismiss_idle(far, 8'001);
  REQUIRE(test::count(challengers) == 1);
  CHECK(challengers.begin()->kind() == Kind::kWall);

  challengers.add(Kind::kTwin, kContext, kStart, 8'000, 0);
  const ContourFilter faster({}, {.position = {301, 200}, .velocity = {100, 0}}, 0);
  challengers.dismiss_idle(faster, 8'001);
  CHECK(test::count(challengers) == 2);
  const ContourFilter same({}, {.position = {301, 200}, .velocity = {99, 0}}, 0);
  challengers.dismiss_idle(same, 8'001);
  REQUIRE(test::count(challengers) == 1);
  CHECK(challengers.begin()->kind() == Kind::kWall);
}

// Whether what follows a puck is still there at that age.
bool lives_until(std::int64_t age_us, PixelVelocity velocity) {
  test::MovingContour puck(kContext.contour, {300, 200}, velocity);
  Challengers challengers;
  find(challengers, {{{300, 200}, 0.5}});
  for (std::int64_t t = 0; t < age_us; t += 1'000) {
    for (const ContourEvent& event : puck.events(t, t + 1'000)) {
      challengers.take(event, 0, kContext);
    }
    challengers.decide(t + 1'000, kContext);
  }
  challengers.dismiss_hopeless(age_us, true);
  return test::count(challengers) > 0;
}

TEST_CASE(
    "While there is no track, what was found is given up at 60 ms, or, if it thrives, at 150 ms") {
  CHECK(lives_until(60'000, {8, 0}));
  CHECK_FALSE(lives_until(61'000, {8, 0}));
  CHECK(lives_until(150'000, {300, 0}));
  CHECK_FALSE(lives_until(151'000, {300, 0}));
}

// When the first is found among two of which one follows a moving puck, µs.
std::int64_t first_found_us(double score, PixelVelocity velocity) {
  test::MovingContour puck(kContext.contour, {300, 200}, velocity);
  Challengers challengers;
  find(challengers, {{{100, 400}, 0.9}, {{300, 200}, score}});
  for (std::int64_t t = 0; t < 60'000; t += 1'000) {
    for (const ContourEvent& event : puck.events(t, t + 1'000)) {
      challengers.take(event, 0, kContext);
    }
    challengers.decide(t + 1'000, kContext);
    const Challenger* first = challengers.first({}, 0, t + 1'000);
    if (first == nullptr) continue;
    CHECK(distance_px(first->track().filter().position(), puck.position_at(t + 1'000)) < 2);
    return t + 1'000;
  }
  return 60'000;
}

TEST_CASE(
    "The first is found 3 ms after it is evident, likely, or moves by itself, or not at all") {
  const std::int64_t evident_us = first_found_us(0.9, {700, 200});
  CHECK(evident_us >= 9'000);
  CHECK(evident_us < 16'000);
  const std::int64_t likely_us = first_found_us(0.5, {200, 0});
  CHECK(likely_us >= 14'000);
  CHECK(likely_us < 20'000);
  const std::int64_t moving_us = first_found_us(0.4, {700, 200});
  CHECK(moving_us >= 16'000);
  CHECK(moving_us < 30'000);
  CHECK(first_found_us(0.4, {200, 0}) == 60'000);
}

// When one of two succeeds a track without events, the one that follows a moving puck, µs.
std::int64_t successor_found_us(const ClaimContext& claims) {
  test::MovingContour puck(kContext.contour, {300, 200}, {700, 200});
  Challengers challengers;
  find(challengers, {{{100, 400}, 0.5}, {{300, 200}, 0.5}});
  for (std::int64_t t = 0; t < 60'000;) {
    for (const ContourEvent& event : puck.events(t, t + 1'000)) {
      challengers.take(event, 0, kContext);
    }
    t += 1'000;
    challengers.decide(t, kContext);
    const Challenger* successor = challengers.successor({}, claims, t);
    if (successor == nullptr) continue;
    CHECK(distance_px(successor->track().filter().position(), puck.position_at(t)) < 3);
    return t;
  }
  return 60'000;
}

TEST_CASE("The successor of a track without events is the one that has them") {
  // It moves by itself from 12 ms on, and must do so for 1.5.
  const std::int64_t slowly_us = successor_found_us({.at_once = false});
  CHECK(slowly_us >= 14'000);
  CHECK(slowly_us < 16'000);
  const std::int64_t at_once_us = successor_found_us({});
  CHECK(at_once_us >= 3'000);
  CHECK(at_once_us < 6'000);
}

}  // namespace
}  // namespace puck
