#include "common/vision/sighting_trails.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"
#include "tests/vision/sighting_walk.h"
#include "tests/vision/turning_scene.h"

namespace puck {
namespace {

using test::kSearchPeriod_us;
using test::kSensor;
using test::TurningScene;

const PuckContour kLyingContour(kSensor, {30, 0, 0, 20, 0, 0}, {0, 0, 0}, true);
const Region kEverywhere = Region::all_of(kSensor);

/// Searches one after another, of a head that rests.
class Searches {
 public:
  /// Of the first candidate.
  SightingTrail find(const std::vector<SearchCandidate>& candidates,
                     const Region& region = kEverywhere, bool other_wall = false) {
    time_us_ += kSearchPeriod_us;
    found_ = {{time_us_}, {.region = region, .other_wall = other_wall}, candidates};
    trails_.take(found_, kLyingContour, background_, true);
    return candidates.empty() ? SightingTrail{} : trail(0);
  }
  /// Of one of the last search.
  SightingTrail trail(std::size_t candidate) const { return found_.candidates[candidate].trail; }
  void wait(std::int64_t us) { time_us_ += us; }

 private:
  SearchResult found_;
  SightingTrails trails_;
  Background background_{kSensor};
  std::int64_t time_us_ = 1'000'000;
};

// 400 px/s to the right.
SearchCandidate step(int i, double score = 0.52) { return {{200 + 2.0 * i, 150}, score}; }

TEST_CASE("What is found again and again along its way leaves a trail, clutter does not") {
  Searches searches;
  std::uint32_t state = 1;
  const auto random = [&](int most) {
    state = state * 1664525u + 1013904223u;
    return static_cast<double>(state >> 8) / 0x1p24 * most;
  };
  int likely_clutter = 0;
  SightingTrail trail;
  for (int i = 0; i < 12; ++i) {
    std::vector<SearchCandidate> candidates{step(i)};
    for (int n = 0; n < 40; ++n) {
      candidates.push_back({{random(kSensor.width), random(kSensor.height)}, 0.6});
    }
    trail = searches.find(candidates);
    for (std::size_t n = 1; n < candidates.size(); ++n) {
      if (searches.trail(n).is_likely()) ++likely_clutter;
    }
    CHECK(trail.sightings == i + 1);
    CHECK(trail.is_likely() == (i >= 3));
    CHECK(trail.is_steady() == (i >= 5));
    CHECK(trail.is_certain() == (i >= 11));
  }
  CHECK(likely_clutter == 0);
  // 22 px, of which a little has been forgotten.
  CHECK(trail.own_px == doctest::Approx(20.3).epsilon(0.01));
  CHECK(trail.score == doctest::Approx(0.52));
  CHECK(trail.rms_px == doctest::Approx(0).epsilon(1e-6));
  CHECK(trail.velocity.x == doctest::Approx(400));
  CHECK(trail.velocity.y == doctest::Approx(0));
}

TEST_CASE("Each of what a search found has its own trail, in whatever order it comes") {
  Searches searches;
  for (int i = 0; i < 7; ++i) searches.find({step(i)});
  searches.find({{{400, 300}, 0.9}, step(7), {{100, 60}, 0.3}});
  CHECK(searches.trail(0).sightings == 1);
  CHECK(searches.trail(1).sightings == 8);
  CHECK(searches.trail(2).sightings == 1);
  CHECK(searches.trail(0).score == 0.9);
  CHECK(searches.trail(2).score == 0.3);
}

TEST_CASE("What stays where it is gets nowhere, however often it is found") {
  Searches searches;
  SightingTrail trail;
  for (int i = 0; i < 100; ++i) trail = searches.find({{{200 + 0.5 * (i % 2), 150}, 0.9}});
  CHECK(trail.sightings == 100);
  CHECK(trail.own_px < 1);
  CHECK_FALSE(trail.is_likely());
}

TEST_CASE("What jumps about is not steady, and what hardly looks like a puck neither") {
  Searches searches;
  SightingTrail trail;
  for (int i = 0; i < 30; ++i) {
    trail = searches.find({{{200 + 2.0 * i, 150 + (i % 2 ? 1.4 : 0)}, 0.9}});
  }
  CHECK(trail.sightings >= 12);
  CHECK(trail.rms_px > 0.9);
  CHECK_FALSE(trail.is_steady());

  Searches others;
  for (int i = 0; i < 30; ++i) trail = others.find({step(i, 0.39)});
  CHECK(trail.is_likely());
  CHECK_FALSE(trail.is_steady());
  // Its score is that of the last ten or so.
  for (int i = 30; i < 60; ++i) trail = others.find({step(i, 0.6)});
  CHECK(trail.score > 0.58);
  CHECK(trail.is_certain());
}

TEST_CASE("Two searches may miss it, a third may not") {
  const auto sightings_after = [](int missed) {
    Searches searches;
    for (int i = 0; i < 6; ++i) searches.find({step(i)});
    for (int i = 0; i < missed; ++i) searches.find({});
    return searches.find({step(6 + missed)}).sightings;
  };
  CHECK(sightings_after(2) == 7);
  CHECK(sightings_after(3) == 1);
}

TEST_CASE("A search of another region misses nothing, but a trail waits for 25 ms only") {
  const auto sightings_after = [](int searches_elsewhere) {
    Searches searches;
    for (int i = 0; i < 6; ++i) searches.find({step(i)});
    for (int i = 0; i < searches_elsewhere; ++i) searches.find({}, {400, 300, 100, 100});
    return searches.find({step(6 + searches_elsewhere)}).sightings;
  };
  CHECK(sightings_after(4) == 7);
  CHECK(sightings_after(5) == 1);

  Searches searches;
  for (int i = 0; i < 6; ++i) searches.find({step(i)});
  searches.wait(35'000);
  CHECK(searches.find({step(13)}).sightings == 1);
}

TEST_CASE("A search within 2 ms of the last sees the same: it adds nothing, but knows the trail") {
  Searches searches;
  for (int i = 0; i < 6; ++i) searches.find({step(i)});
  const SightingTrail before = searches.trail(0);
  searches.wait(-4'000);
  const SearchCandidate again{{step(5).position.x + 1, step(5).position.y}, 0.9};
  const SightingTrail same = searches.find({again});
  CHECK(same.sightings == 6);
  CHECK(same.score == before.score);
  CHECK(same.velocity.x == before.velocity.x);
  CHECK(same.seen_us == before.seen_us);
  searches.wait(-1'000);
  CHECK(searches.find({step(6)}).sightings == 7);
}

TEST_CASE("How far it has come is soon forgotten once it stays") {
  Searches searches;
  SearchCandidate candidate = step(0);
  double step_px = 2;
  SightingTrail trail;
  for (int i = 0; i < 200; ++i) {
    trail = searches.find({candidate});
    CHECK(trail.sightings == i + 1);
    if (i == 20) CHECK(trail.is_certain());
    if (i > 20) step_px *= 0.95;
    candidate.position.x += step_px;
  }
  CHECK(trail.own_px < 8);
  CHECK_FALSE(trail.is_steady());
}

TEST_CASE("A search for the other side wall finds the same puck elsewhere and follows it") {
  const double other = kLyingContour.other_wall_share();
  REQUIRE(other > 0.1);
  Searches searches;
  SightingTrail trail;
  for (int i = 0; i < 12; ++i) {
    const bool other_wall = i % 2 == 1;
    SearchCandidate candidate = step(i);
    if (other_wall) {
      candidate.position = kLyingContour.centre_with_wall(
          candidate.position, kLyingContour.calibrated_wall_share(), other);
    }
    trail = searches.find({candidate}, kEverywhere, other_wall);
  }
  CHECK(trail.is_certain());
  CHECK(trail.velocity.y == doctest::Approx(0).epsilon(1e-6));
}

TEST_CASE(
    "Under a turning head what moves with the scene gets nowhere, what moves by itself does") {
  Background background(TurningScene::kSensor);
  TurningScene scene;
  scene.show(background, 600);
  REQUIRE(background.head_turns());
  SightingTrails trails;
  SightingTrail of_mark;
  SightingTrail of_puck;
  int steady_marks = 0;
  // From one side to the other and back.
  for (int i = 0; i < 400; ++i) {
    scene.show(background, 5);
    const double sway_px = TurningScene::sway_px(scene.time_us());
    const SearchCandidate mark{{320 + sway_px, 240}, 0.6};
    const SearchCandidate puck{{50 + sway_px + 1.3 * i, 105}, 0.6};
    SearchResult found{{scene.time_us()}, {.region = kEverywhere}, {mark, puck}};
    trails.take(found, kLyingContour, background, false);
    of_mark = found.candidates[0].trail;
    of_puck = found.candidates[1].trail;
    if (of_mark.is_steady()) ++steady_marks;
  }
  CHECK(of_mark.sightings == 400);
  CHECK(steady_marks == 0);
  CHECK(of_puck.is_certain());
  // 260 px/s for 0.3 s.
  CHECK(of_puck.own_px == doctest::Approx(78).epsilon(0.1));
}

TEST_CASE("While it is not known how what stands still moves nothing has moved by itself") {
  SightingTrails trails;
  SightingTrail trail;
  for (int i = 0; i < 20; ++i) {
    SearchResult found{{kSearchPeriod_us * i}, {.region = kEverywhere}, {step(i)}};
    trails.take(found, kLyingContour, Background(kSensor), false);
    trail = found.candidates[0].trail;
  }
  CHECK(trail.sightings == 20);
  CHECK(trail.own_px == 0);
  CHECK_FALSE(trail.is_likely());
}

TEST_CASE(
    "Of more sightings than a search makes, and more trails than four leave, some are left out") {
  // So many in rows that are far from one another.
  const auto row = [](int n, int count) {
    std::vector<SearchCandidate> candidates;
    for (int i = 0; i < count; ++i) candidates.push_back({{12.0 * (i + 1), 20.0 * (n + 1)}, 0.5});
    return candidates;
  };
  Searches searches;
  CHECK(searches.find(row(0, 50)).sightings == 1);
  CHECK(searches.trail(47).sightings == 1);
  CHECK(searches.trail(48).sightings == 0);
  // None of these misses the others.
  const Region elsewhere{600, 440, 30, 30};
  for (int n = 1; n < 4; ++n) CHECK(searches.find(row(n, 48), elsewhere).sightings == 1);
  CHECK(searches.trail(47).sightings == 1);
  CHECK(searches.find(row(4, 48), elsewhere).sightings == 0);
}

}  // namespace
}  // namespace puck
