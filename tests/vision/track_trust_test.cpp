#include "common/vision/track_trust.h"

#include <doctest/doctest.h>

namespace puck {
namespace {

constexpr TrackLooks kSound{.quality = 0.9, .strength = 50, .cover = 0.8};
constexpr TrackLooks kFair{.quality = 0.6, .strength = 50};
constexpr TrackLooks kBad{.quality = 0.2, .strength = 50};
constexpr TrackLooks kCovered{.quality = 0.2, .strength = 50, .inside_events = 13};
constexpr TrackLooks kFast{.speed_px_s = 301, .quality = 0.9, .strength = 50};

// A track that decisions, 500 µs apart, are made about.
struct Judged {
  void look(const TrackLooks& looks, int milliseconds, bool resting = false,
            double seen_score = 0) {
    for (int i = 0; i < 2 * milliseconds; ++i) {
      now_us += 500;
      trust.judge(looks, seen_score, resting, now_us, 500);
    }
  }
  TrackTrust trust;
  std::int64_t now_us = 0;
};

TEST_CASE("A track is trusted once it has been sound for more than 200 ms") {
  Judged track;
  track.look(kSound, 200);
  CHECK_FALSE(track.trust.is_trusted());
  track.look(kSound, 1);
  CHECK(track.trust.is_trusted());
  CHECK(track.trust.since_sound_us(track.now_us) == 0);
}

TEST_CASE("Trust wanes as fast as it grew, is never more than a second's, and is kept at rest") {
  Judged track;
  track.look(kSound, 3'000);
  track.look(kBad, 500, true);
  track.look(kBad, 799);
  CHECK(track.trust.is_trusted());
  track.look(kBad, 1);
  CHECK_FALSE(track.trust.is_trusted());
  CHECK_FALSE(track.trust.is_exhausted());
  track.look(kBad, 200);
  CHECK(track.trust.is_exhausted());
}

TEST_CASE("A track was covered from when something is inside its ring until it is sound again") {
  Judged track;
  track.look(kSound, 100);
  CHECK_FALSE(track.trust.was_covered());
  TrackLooks hardly_covered = kCovered;
  hardly_covered.inside_events = 12;
  track.look(hardly_covered, 1);
  CHECK_FALSE(track.trust.was_covered());
  track.look(kCovered, 1);
  track.look(kBad, 1'000, true);
  CHECK(track.trust.was_covered());
  track.look(kSound, 1);
  CHECK_FALSE(track.trust.was_covered());
  track.look(kCovered, 1);
  track.trust.note_found(false, track.now_us);
  CHECK_FALSE(track.trust.was_covered());
}

TEST_CASE("What is sound on few sides is half hidden, and covered all the same") {
  Judged track;
  track.look(kCovered, 1);
  TrackLooks half = kSound;
  half.cover = 0.5;
  track.look(half, 1);
  CHECK(track.trust.was_covered());
  half.cover = 0.51;
  half.quality = TrackTrust::kSound;
  track.look(half, 1);
  CHECK(track.trust.was_covered());
  half.quality = 0.9;
  track.look(half, 1);
  CHECK_FALSE(track.trust.was_covered());
}

TEST_CASE("A track is proven once it has been sound and fast for more than 30 ms on end") {
  Judged track;
  track.look(kFast, 30);
  track.look(kSound, 1);
  track.look(kFast, 30);
  CHECK_FALSE(track.trust.is_proven());
  track.look(kFast, 1);
  CHECK(track.trust.is_proven());
  track.look(kBad, 50);
  CHECK(track.trust.is_proven());
  track.look(kBad, 50);
  CHECK_FALSE(track.trust.is_proven());
}

TEST_CASE("What is good but not sound stops one clock only") {
  Judged track;
  track.look(kSound, 10);
  track.look(kFair, 5);
  track.look(kBad, 5);
  CHECK(track.trust.since_good_us(track.now_us) == 5'000);
  CHECK(track.trust.since_sound_us(track.now_us) == 10'000);
  track.trust.note_takeover(track.now_us);
  CHECK(track.trust.since_good_us(track.now_us) == 0);
}

TEST_CASE(
    "What was found is trusted half as much, and must be sound for 20 ms before it may rest") {
  Judged track;
  track.look(kFast, 300);
  track.trust.note_found(true, track.now_us);
  CHECK_FALSE(track.trust.is_trusted());
  CHECK_FALSE(track.trust.is_proven());
  CHECK_FALSE(track.trust.is_believed());
  track.look(kSound, 20);
  CHECK_FALSE(track.trust.may_rest());
  CHECK_FALSE(track.trust.is_believed());
  track.look(kSound, 1);
  CHECK(track.trust.may_rest());
  CHECK(track.trust.is_believed());
}

TEST_CASE("A track that a search has just seen counts as good, not as sound") {
  Judged track;
  track.look(kSound, 1);
  track.look(kBad, 10);
  track.trust.note_seen(track.now_us);
  CHECK(track.trust.since_good_us(track.now_us) == 0);
  CHECK(track.trust.since_sound_us(track.now_us) == 10'000);
}

TEST_CASE("What was found weakly and then moves as a puck does for 3 ms is believed") {
  Judged track;
  track.look(kSound, 100);
  TrackLooks moving = kFast;
  moving.cover = 0.36;
  REQUIRE(moving.moves_as_pucks_do());
  const auto is_believed_after = [&](const TrackLooks& looks, int milliseconds) {
    track.trust.note_found(true, track.now_us);
    track.look(looks, milliseconds);
    return track.trust.is_believed();
  };
  CHECK_FALSE(is_believed_after(moving, 2));
  CHECK(is_believed_after(moving, 3));
  moving.growth_px = 0.45;
  CHECK_FALSE(is_believed_after(moving, 3));
  moving.growth_px = 0;
  moving.strength = 25;
  CHECK_FALSE(is_believed_after(moving, 3));
  moving.strength = 50;
  moving.cover = 0.35;
  CHECK_FALSE(is_believed_after(moving, 3));
  moving.cover = 0.36;
  // Not twice for half as long.
  track.trust.note_found(true, track.now_us);
  track.look(moving, 2);
  track.look(kSound, 1);
  track.look(moving, 2);
  CHECK_FALSE(track.trust.is_believed());
}

// Beside a hand: of less than sound quality, but with many events on a moving puck's ring.
constexpr TrackLooks kBesideHand{
    .speed_px_s = 301, .growth_px = 0.34, .quality = 0.61, .strength = 81, .cover = 0.36};

TEST_CASE("What was found weakly and has many events on a ring of a puck's size is believed, too") {
  const auto is_believed = [](const TrackLooks& looks) {
    Judged track;
    track.look(kSound, 100);
    track.trust.note_found(true, track.now_us);
    track.look(looks, 3);
    return track.trust.is_believed();
  };
  CHECK(is_believed(kBesideHand));
  const auto but = [](double TrackLooks::*field, double value) {
    TrackLooks looks = kBesideHand;
    looks.*field = value;
    return looks;
  };
  CHECK_FALSE(is_believed(but(&TrackLooks::quality, 0.6)));
  CHECK_FALSE(is_believed(but(&TrackLooks::strength, 80)));
  CHECK_FALSE(is_believed(but(&TrackLooks::growth_px, 0.35)));
  CHECK_FALSE(is_believed(but(&TrackLooks::speed_px_s, 300)));
  CHECK_FALSE(is_believed(but(&TrackLooks::cover, 0.35)));
}

TEST_CASE("A track of many events that searches see as a puck is as good as sound") {
  Judged track;
  track.look(kSound, 100);
  track.look(kBesideHand, 10, false, 0.55);
  CHECK(track.trust.since_sound_us(track.now_us) == 10'000);
  track.look(kBesideHand, 10, false, 0.56);
  CHECK(track.trust.since_sound_us(track.now_us) == 0);
  TrackLooks larger = kBesideHand;
  larger.growth_px = 0.35;
  track.look(larger, 10, false, 0.9);
  CHECK(track.trust.since_sound_us(track.now_us) == 10'000);
  larger.strength = 301;
  track.look(larger, 10, false, 0.9);
  CHECK(track.trust.since_sound_us(track.now_us) == 0);
}

TEST_CASE("A track is unsound only while it is to be seen") {
  Judged track;
  track.look(kSound, 10);
  track.look(kBad, 30);
  track.look(kBad, 50, true);
  track.look(kBad, 5);
  CHECK(track.trust.unsound_us() == 35'000);
  CHECK(track.trust.since_sound_us(track.now_us) == 85'000);
  track.look(kSound, 1);
  CHECK(track.trust.unsound_us() == 0);
}

TEST_CASE("What was found on good evidence is believed at once") {
  TrackTrust trust;
  trust.note_found(false, 1'000);
  CHECK(trust.is_believed());
}

}  // namespace
}  // namespace puck
