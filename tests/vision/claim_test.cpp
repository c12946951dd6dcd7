#include "common/vision/claim.h"

#include <cmath>
#include <optional>

#include <doctest/doctest.h>

#include "common/vision/background.h"
#include "common/vision/puck_contour.h"
#include "tests/vision/turning_scene.h"

namespace puck {
namespace {

// Just clear at once, by its strength alone.
constexpr Claim kStrong{
    .looks = {.speed_px_s = 301, .growth_px = 0.34, .quality = 0.66, .strength = 81, .cover = 0.29},
    .age_us = 1'001,
    .leads = true};

Claim with(const Claim& claim, double TrackLooks::*field, double value) {
  Claim changed = claim;
  changed.looks.*field = value;
  return changed;
}

TEST_CASE("Many events on a moving puck's ring are clear at once, whatever the search says") {
  CHECK(is_clear_at_once(kStrong));
  CHECK_FALSE(is_clear_at_once(with(kStrong, &TrackLooks::quality, 0.65)));
  CHECK_FALSE(is_clear_at_once(with(kStrong, &TrackLooks::strength, 80)));
}

TEST_CASE("Of better quality fewer events are clear at once") {
  Claim good = with(kStrong, &TrackLooks::quality, 0.86);
  good = with(good, &TrackLooks::strength, 61);
  CHECK(is_clear_at_once(good));
  CHECK_FALSE(is_clear_at_once(with(good, &TrackLooks::strength, 60)));
  CHECK_FALSE(is_clear_at_once(with(good, &TrackLooks::quality, 0.85)));
}

TEST_CASE("What the search scores high is clear with hardly any events") {
  Claim seen = with(kStrong, &TrackLooks::strength, 8);
  seen.looks.quality = 0.75;
  seen.found.score = 0.71;
  CHECK(is_clear_at_once(seen));
  CHECK_FALSE(is_clear_at_once(with(seen, &TrackLooks::quality, 0.72)));
  seen.found.score = 0.69;
  CHECK_FALSE(is_clear_at_once(seen));
  seen.found.score = 0.9;
  CHECK_FALSE(is_clear_at_once(with(seen, &TrackLooks::quality, 0.69)));
}

TEST_CASE("What stands, hardly covers the ring, has another size or no lead is not clear at once") {
  CHECK_FALSE(is_clear_at_once(with(kStrong, &TrackLooks::speed_px_s, 300)));
  CHECK_FALSE(is_clear_at_once(with(kStrong, &TrackLooks::cover, 0.28)));
  CHECK_FALSE(is_clear_at_once(with(kStrong, &TrackLooks::growth_px, 0.35)));
  CHECK(is_clear_at_once(with(kStrong, &TrackLooks::growth_px, -0.34)));
  CHECK_FALSE(is_clear_at_once(with(kStrong, &TrackLooks::growth_px, -0.35)));
  Claim claim = kStrong;
  claim.leads = false;
  CHECK_FALSE(is_clear_at_once(claim));
  claim = kStrong;
  claim.age_us = 1'000;
  CHECK_FALSE(is_clear_at_once(claim));
  claim = kStrong;
  claim.context.at_once = false;
  CHECK_FALSE(is_clear_at_once(claim));
}

// Just likely, at rest.
constexpr Claim kRing{.looks = {.growth_px = 0.34, .quality = 0.76, .strength = 16, .cover = 0.51},
                      .age_us = 10'001,
                      .found = {.score = 0.58}};

TEST_CASE("A whole ring is likely to be the puck where events and search support each other") {
  CHECK(is_likely(kRing));
  CHECK_FALSE(is_likely(with(kRing, &TrackLooks::quality, 0.73)));
  CHECK_FALSE(is_likely(with(kRing, &TrackLooks::strength, 15)));
  CHECK_FALSE(is_likely(with(kRing, &TrackLooks::cover, 0.5)));
  CHECK_FALSE(is_likely(with(kRing, &TrackLooks::growth_px, 0.35)));
  CHECK_FALSE(is_likely(with(kRing, &TrackLooks::growth_px, -0.35)));
  Claim claim = kRing;
  claim.found.score = 0.56;
  CHECK_FALSE(is_likely(claim));
  CHECK(is_likely(with(claim, &TrackLooks::quality, 0.79)));
  claim.found.score = 0.9;
  CHECK_FALSE(is_likely(with(claim, &TrackLooks::quality, 0.75)));
  claim = kRing;
  claim.age_us = 10'000;
  CHECK_FALSE(is_likely(claim));
  claim = kRing;
  claim.context.at_once = false;
  CHECK_FALSE(is_likely(claim));
}

// A printed puck at rest, just clear enough.
constexpr Claim kPrinted{
    .looks = {.growth_px = 0.34, .printed_quality = 0.76, .strength = 41, .cover = 0.76},
    .age_us = 10'001,
    .found = {.score = 0.61},
    .leads = true};

TEST_CASE("A ring all around that stands out from its surroundings may be a printed puck's") {
  CHECK(may_be_printed(kPrinted));
  CHECK_FALSE(may_be_printed(with(kPrinted, &TrackLooks::printed_quality, 0.75)));
  CHECK_FALSE(may_be_printed(with(kPrinted, &TrackLooks::strength, 40)));
  CHECK_FALSE(may_be_printed(with(kPrinted, &TrackLooks::cover, 0.75)));
  CHECK_FALSE(may_be_printed(with(kPrinted, &TrackLooks::growth_px, 0.35)));
  // The print draws the contour in.
  CHECK(may_be_printed(with(kPrinted, &TrackLooks::growth_px, -0.59)));
  CHECK_FALSE(may_be_printed(with(kPrinted, &TrackLooks::growth_px, -0.6)));
  Claim claim = kPrinted;
  claim.found.score = 0.6;
  CHECK_FALSE(may_be_printed(claim));
  claim = kPrinted;
  claim.age_us = 10'000;
  CHECK_FALSE(may_be_printed(claim));
  claim = kPrinted;
  claim.leads = false;
  CHECK_FALSE(may_be_printed(claim));
  claim = kPrinted;
  claim.context.face_print = false;
  CHECK_FALSE(may_be_printed(claim));
}

// Just adrift.
constexpr Claim kAdrift{.looks = {.turning_px_s = 300, .strength = 80, .cover = 0.51},
                        .own_speed_px_s = 151};

Claim at_own_speed(const Claim& claim, std::optional<double> speed_px_s) {
  Claim changed = claim;
  changed.own_speed_px_s = speed_px_s;
  return changed;
}

// Just seen to rest in the scene.
constexpr Claim kResting{
    .looks = {.growth_px = 0.34, .quality = 0.76, .strength = 13, .cover = 0.61},
    .age_us = 15'001,
    .leads = true,
    .own_speed_px_s = 59};

TEST_CASE("A ring of a puck's size that moves with the scene rests in it, few events or not") {
  CHECK(rests_in_scene(kResting));
  CHECK_FALSE(rests_in_scene(at_own_speed(kResting, 60)));
  CHECK_FALSE(rests_in_scene(at_own_speed(kResting, std::nullopt)));
  CHECK_FALSE(rests_in_scene(with(kResting, &TrackLooks::quality, 0.75)));
  CHECK_FALSE(rests_in_scene(with(kResting, &TrackLooks::strength, 12)));
  CHECK_FALSE(rests_in_scene(with(kResting, &TrackLooks::cover, 0.6)));
  CHECK_FALSE(rests_in_scene(with(kResting, &TrackLooks::growth_px, 0.35)));
  CHECK_FALSE(rests_in_scene(with(kResting, &TrackLooks::growth_px, -0.35)));
  Claim claim = kResting;
  claim.age_us = 15'000;
  CHECK_FALSE(rests_in_scene(claim));
  claim = kResting;
  claim.leads = false;
  CHECK_FALSE(rests_in_scene(claim));
  claim = kResting;
  claim.context.scene_rests = false;
  CHECK_FALSE(rests_in_scene(claim));
}

TEST_CASE("What moves neither with the scene nor clearly by itself is adrift") {
  CHECK(is_adrift(kAdrift));
  CHECK_FALSE(is_adrift(at_own_speed(kAdrift, 150)));
  CHECK_FALSE(is_adrift(at_own_speed(kAdrift, std::nullopt)));
  CHECK_FALSE(is_adrift(with(kAdrift, &TrackLooks::strength, 81)));
  // A whole ring that is far faster than the scene was hit.
  CHECK(is_adrift(at_own_speed(kAdrift, 600)));
  CHECK_FALSE(is_adrift(at_own_speed(kAdrift, 601)));
  CHECK(is_adrift(at_own_speed(with(kAdrift, &TrackLooks::cover, 0.5), 601)));
}

TEST_CASE("Where the scene turns slowly the filter's noise is not taken for a drift") {
  const Claim small = with(kAdrift, &TrackLooks::turning_px_s, 100);
  CHECK(is_adrift(at_own_speed(small, 121)));
  CHECK_FALSE(is_adrift(at_own_speed(small, 120)));
}

TEST_CASE("A claim says how fast it is in the scene, while it is known how that moves") {
  const PuckSizeModel size{.width_0 = 40, .height_0 = 30};
  const ContourContext tracks{PuckContour(test::TurningScene::kSensor, size, {}, true), {}, {}, {}};
  ContourFilter::Start start;
  start.position = {300, 200};
  start.velocity = {400, -100};
  const Challenger challenger(Challenger::Kind::kSearch, tracks, start, 0, 0, {});
  Background background(test::TurningScene::kSensor);
  ClaimContext context{.background = &background};
  CHECK_FALSE(claim_of(challenger, context, 0).own_speed_px_s);
  test::TurningScene scene;
  scene.show(background, 400);
  REQUIRE(background.head_turns());
  const PixelVelocity still = background.still_velocity_at({300, 200}).value();
  CHECK(claim_of(challenger, context, 0).own_speed_px_s.value() ==
        doctest::Approx(std::hypot(400 - still.x, -100 - still.y)));
  context.background = nullptr;
  CHECK_FALSE(claim_of(challenger, context, 0).own_speed_px_s);
}

TEST_CASE("A trail speaks for a claim until 25 ms after it was last found") {
  const PuckContour contour(test::TurningScene::kSensor, {30, 0, 0, 30, 0, 0}, {0, 0, 0}, true);
  const ContourContext context{contour, {}, {}, {}};
  const Challenger challenger(Challenger::Kind::kSearch, context, {.position = {320, 240}}, 0, 0,
                              {.score = 0.5, .trail = {.sightings = 8, .seen_us = 100'000}});
  CHECK(claim_of(challenger, {}, 125'000).found.trail.sightings == 8);
  const Claim late = claim_of(challenger, {}, 125'001);
  CHECK(late.found.trail.sightings == 0);
  CHECK(late.found.score == 0.5);
}

}  // namespace
}  // namespace puck
