#include "common/vision/track_standing.h"

#include <doctest/doctest.h>

#include "tests/vision/contour_world.h"

namespace puck {
namespace {

using test::kSensor;
using test::sound;

constexpr TrackLooks kGliding{
    .position = {300, 200}, .speed_px_s = 500, .quality = 0.9, .strength = 50, .near_events = 60};
constexpr TrackLooks kSilent{.position = {300, 200}, .speed_px_s = 20};
constexpr TrackLooks kOutside{.position = {650, 200}, .speed_px_s = 500};

TEST_CASE("A track that has rested for more than 200 ms without a break has settled") {
  TrackStanding standing(kSensor, 50'000);
  standing.judge(kGliding, true, false, sound(), 100'000);
  standing.judge(kSilent, true, false, sound(), 100'500);
  CHECK(standing.is_resting());
  CHECK_FALSE(standing.has_settled(300'000));
  CHECK(standing.has_settled(300'001));
  standing.judge(kGliding, true, false, sound(), 300'500);
  CHECK_FALSE(standing.has_settled(300'500));
}

TEST_CASE("While the head turns nothing rests, since what does makes events") {
  TrackStanding standing(kSensor, 50'000);
  standing.judge(kGliding, true, true, sound(), 100'000);
  standing.judge(kSilent, true, true, sound(), 150'001);
  CHECK_FALSE(standing.is_resting());
  CHECK(standing.state() == TrackState::kLost);
}

TEST_CASE("A track without support is believed for as long as it may coast") {
  TrackStanding standing(kSensor, 50'000);
  CHECK(standing.state() == TrackState::kSearching);
  standing.judge(kGliding, true, false, sound(), 100'000);
  CHECK(standing.state() == TrackState::kTracking);
  standing.judge(kSilent, false, false, sound(), 150'000);
  CHECK(standing.state() == TrackState::kTracking);
  standing.judge(kSilent, false, false, sound(), 150'001);
  CHECK(standing.state() == TrackState::kLost);
  CHECK_FALSE(standing.left_image().has_value());
}

TEST_CASE("What a search has just seen where it is followed goes on to be") {
  TrackStanding standing(kSensor, 50'000);
  standing.judge(kGliding, true, false, sound(), 200'000);
  standing.note_seen(240'000);
  standing.judge(kSilent, false, false, sound(), 290'000);
  CHECK(standing.state() == TrackState::kTracking);
  standing.judge(kSilent, false, false, sound(), 290'001);
  CHECK(standing.state() == TrackState::kLost);
}

TEST_CASE("What a search has seen in the image has not left it") {
  TrackStanding standing(kSensor, 50'000);
  standing.judge(kGliding, true, false, sound(), 200'000);
  standing.judge(kOutside, false, false, sound(), 210'001);
  REQUIRE(standing.state() == TrackState::kLost);
  REQUIRE(standing.left_image().has_value());
  standing.note_seen(300'000);
  standing.judge(kSilent, false, false, sound(), 300'500);
  CHECK(standing.state() == TrackState::kTracking);
  CHECK_FALSE(standing.left_image().has_value());
}

TEST_CASE("A slow, quiet puck that the witness sees, too, rests for ever") {
  TrackStanding standing(kSensor, 50'000);
  standing.judge(kGliding, true, false, sound(), 100'000);
  CHECK_FALSE(standing.is_resting());
  for (std::int64_t t = 101'000; t < 400'000; t += 1'000) {
    standing.judge(kSilent, true, false, sound(), t);
  }
  CHECK(standing.is_resting());
  CHECK(standing.state() == TrackState::kTracking);
}

TEST_CASE(
    "What has never been sound does not rest, nor what is fast or has the witness against it") {
  TrackStanding standing(kSensor, 50'000);
  standing.judge(kSilent, true, false, TrackTrust(), 100'000);
  CHECK_FALSE(standing.is_resting());
  standing.judge(kSilent, false, false, sound(), 100'000);
  CHECK_FALSE(standing.is_resting());
  TrackLooks fast = kSilent;
  fast.speed_px_s = 60;
  standing.judge(fast, true, false, sound(), 100'000);
  CHECK_FALSE(standing.is_resting());
}

// Trust in a track that has been sound for 300 ms.
TrackTrust trusted() {
  TrackTrust trust;
  trust.judge(kGliding, 0, false, 300'000, 300'000);
  return trust;
}

// Of a trusted track that was good, and looks like this 100 ms later.
TrackState state_after(const TrackLooks& looks, bool witness_is_near, const TrackTrust& trust) {
  TrackStanding standing(kSensor, 50'000);
  standing.judge(kGliding, true, false, trusted(), 100'000);
  standing.judge(looks, witness_is_near, false, trust, 200'000);
  return standing.state();
}

TEST_CASE("A poor track that is trusted is held as long as the blob and its ring support it") {
  TrackLooks poor = kGliding;
  poor.quality = 0.2;
  poor.strength = 16;
  CHECK(state_after(poor, true, trusted()) == TrackState::kTracking);
  CHECK(state_after(poor, false, trusted()) == TrackState::kLost);
  CHECK(state_after(poor, true, sound()) == TrackState::kLost);
  poor.strength = 15;
  CHECK(state_after(poor, true, trusted()) == TrackState::kLost);
}

// The state of a trusted track that was good with this cover at 100 ms, then looked bad, with so
// much of what is near on its ring, each millisecond until `time_us`, moving on at that speed.
TrackState state_while_caught(double cover, double strength, double px_per_ms,
                              std::int64_t time_us) {
  TrackStanding standing(kSensor, 50'000);
  TrackLooks looks = kGliding;
  looks.cover = cover;
  standing.judge(looks, true, false, trusted(), 100'000);
  looks.quality = 0;
  looks.near_events = 60;
  looks.strength = strength;
  for (std::int64_t t = 101'000; t <= time_us; t += 1'000) {
    looks.position.x += px_per_ms;
    standing.judge(looks, true, false, trusted(), t);
  }
  return standing.state();
}

TEST_CASE("Whatever its quality it is held while more than half of what is near lies on its ring") {
  CHECK(state_while_caught(0.5, 31, 0, 151'000) == TrackState::kTracking);
  CHECK(state_while_caught(0.5, 30, 0, 151'000) == TrackState::kLost);
}

TEST_CASE(
    "It is so only soon after and near where it was whole, since what is not the puck is lost") {
  CHECK(state_while_caught(0.5, 31, 0, 299'000) == TrackState::kTracking);
  CHECK(state_while_caught(0.5, 31, 0, 300'000) == TrackState::kLost);
  CHECK(state_while_caught(0.45, 31, 0, 151'000) == TrackState::kLost);
  CHECK(state_while_caught(0.5, 31, 0.14, 207'000) == TrackState::kTracking);
  CHECK(state_while_caught(0.5, 31, 0.14, 208'000) == TrackState::kLost);
}

// Trust in a track that has been sound and fast for 300 ms.
TrackTrust proven() {
  TrackTrust trust;
  trust.judge(kGliding, 0, false, 100'000, 300'000);
  return trust;
}

// Tracked at 100 ms with this cover, lost, and silent near there; its state then.
TrackState state_at_rest(std::int64_t silent_us, double away_px, double cover,
                         const TrackTrust& trust) {
  TrackLooks seen = kGliding;
  seen.cover = cover;
  TrackStanding standing(kSensor, 50'000);
  standing.judge(seen, true, false, trust, 100'000);
  TrackLooks bad = kGliding;
  bad.quality = bad.strength = 0;
  standing.judge(bad, true, false, trust, silent_us - 1);
  REQUIRE(standing.state() == TrackState::kLost);
  TrackLooks silent = kSilent;
  silent.position.x += away_px;
  standing.judge(silent, true, false, trust, silent_us);
  return standing.state();
}

TEST_CASE(
    "What is bad beside a mallet and falls silent soon, near where it was whole, rests there") {
  CHECK(state_at_rest(200'000, 0, 0.5, proven()) == TrackState::kTracking);
  CHECK(state_at_rest(249'999, 7, 0.5, proven()) == TrackState::kTracking);
  CHECK(state_at_rest(250'000, 7, 0.5, proven()) == TrackState::kLost);
  CHECK(state_at_rest(200'000, 8, 0.5, proven()) == TrackState::kLost);
}

TEST_CASE("What has rested is whole, however few events there were") {
  TrackStanding standing(kSensor, 50'000);
  standing.judge(kGliding, true, false, proven(), 100'000);
  for (std::int64_t t = 101'000; t <= 400'000; t += 1'000) {
    standing.judge(kSilent, true, false, proven(), t);
  }
  TrackLooks bad = kGliding;
  bad.quality = bad.strength = 0;
  standing.judge(bad, true, false, proven(), 451'000);
  REQUIRE(standing.state() == TrackState::kLost);
  standing.judge(kSilent, true, false, proven(), 500'000);
  CHECK(standing.state() == TrackState::kTracking);
}

TEST_CASE("It does not if it was half hidden or covered, nor if it has not proved to be the puck") {
  CHECK(state_at_rest(200'000, 0, 0.45, proven()) == TrackState::kLost);
  TrackTrust covered = proven();
  covered.judge({.inside_events = 13}, 0, true, 100'500, 500);
  CHECK(state_at_rest(200'000, 0, 0.5, covered) == TrackState::kLost);
  CHECK(state_at_rest(200'000, 0, 0.5, sound()) == TrackState::kLost);
}

TEST_CASE("A lost track is not found again by resting") {
  TrackStanding standing(kSensor, 50'000);
  standing.judge(kSilent, true, false, sound(), 200'000);
  CHECK(standing.is_resting());
  CHECK(standing.state() == TrackState::kLost);
}

TEST_CASE("What was found weakly is not followed before it has been sound") {
  TrackTrust trust;
  trust.note_found(true, 100'000);
  TrackStanding standing(kSensor, 50'000);
  standing.judge(kGliding, true, false, trust, 100'000);
  CHECK(standing.state() == TrackState::kLost);
  trust.judge(kGliding, 0, false, 120'001, 500);
  standing.judge(kGliding, true, false, trust, 120'001);
  CHECK(standing.state() == TrackState::kTracking);
}

TEST_CASE("A puck outside the image has left after 10 ms, at the nearest pixel, until it is back") {
  TrackStanding standing(kSensor, 50'000);
  standing.judge(kGliding, true, false, sound(), 100'000);
  standing.judge(kOutside, true, false, sound(), 110'000);
  CHECK(standing.state() == TrackState::kTracking);
  standing.judge(kOutside, true, false, sound(), 110'001);
  CHECK(standing.state() == TrackState::kLost);
  REQUIRE(standing.left_image().has_value());
  CHECK(*standing.left_image() == Pixel{639, 200});
  standing.judge(kGliding, true, false, sound(), 120'000);
  CHECK(standing.state() == TrackState::kTracking);
  CHECK_FALSE(standing.left_image().has_value());
}

}  // namespace
}  // namespace puck
