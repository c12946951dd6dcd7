#include "common/vision/hypotheses/evidence.h"

#include <cmath>

#include <doctest/doctest.h>

#include "common/vision/hypotheses/puck_belief.h"

namespace puck {
namespace {

constexpr EvidenceAreas kAreas{.ring = 200, .inside = 250, .outside = 400, .reach_px = 7};

GameTraits quiet_game() {
  GameTraits game;
  game.noise_px2_s = 0.1;
  return game;
}

// A millisecond of a puck of 25 px that moves to the right at 500 px/s.
EvidencePacket packet_of_puck() {
  EvidencePacket packet;
  packet.seconds = 0.001;
  packet.swept = 20;
  packet.swept_low = 18;
  packet.swept_high = 22;
  packet.flux = {4, 3, 2, 4, 3, 2, 4, 3, 2, 4, 3, 2};
  packet.sectors = {4, 3, 1, 3, 3, 0, 4, 2, 1, 3, 3, 1};
  packet.ring = 28;
  packet.inside = 1;
  packet.outside = 1;
  packet.dark = 24;
  return packet;
}

Evidence evidence_in(const GameTraits& game, const EvidencePacket& packet) {
  return evidence_of(packet, kAreas, 1, game, {});
}

TEST_CASE("events of a whole contour, of one tone, speak for a puck") {
  const Evidence evidence = evidence_in(quiet_game(), packet_of_puck());
  CHECK(evidence.place > 1);
  CHECK(evidence.sector > 0);
  CHECK(evidence.sign > 0);
  CHECK(evidence.told > 0.9);
}

TEST_CASE("events all around a contour and in it speak against a puck") {
  EvidencePacket packet = packet_of_puck();
  packet.ring = 8;
  packet.inside = 10;
  packet.outside = 16;
  CHECK(evidence_in(quiet_game(), packet).place < -1);
}

TEST_CASE("events in one sector of a contour speak against a puck") {
  EvidencePacket packet = packet_of_puck();
  packet.sectors = {28};
  CHECK(evidence_in(quiet_game(), packet).sector < -1);
}

TEST_CASE("events of both signs speak against a puck, and of the other sign than the game's, too") {
  EvidencePacket packet = packet_of_puck();
  packet.dark = packet.bright = 12;
  CHECK(evidence_in(quiet_game(), packet).sign < -1);

  GameTraits game = quiet_game();
  for (int i = 0; i < 10; ++i) game.learn(packet_of_puck());
  packet.dark = 0;
  packet.bright = 24;
  CHECK(evidence_in(game, packet).sign < -1);
}

TEST_CASE("events beside the contour alone never speak for a puck") {
  for (int beside = 1; beside < 40; ++beside) {
    CAPTURE(beside);
    EvidencePacket packet;
    packet.seconds = 0.002;
    packet.outside = beside;
    CHECK(evidence_in(quiet_game(), packet).sum({}) <= 0);
  }
}

TEST_CASE("what the sensor makes by itself says nothing") {
  GameTraits game;
  game.noise_px2_s = 5;
  EvidencePacket packet;
  packet.seconds = 0.01;
  // As many as expected, all of them on the ring.
  packet.ring = 40;
  packet.sectors = {4, 3, 4, 3, 3, 3, 4, 4, 3, 3, 3, 3};
  const Evidence evidence = evidence_in(game, packet);
  CHECK(evidence.told == 0);
  CHECK(evidence.sum({}) == 0);
  CHECK(evidence_in(game, {}).sum({}) == 0);
}

TEST_CASE("no packet says more than its bound") {
  EvidencePacket packet = packet_of_puck();
  for (double* count :
       {&packet.ring, &packet.dark, &packet.swept, &packet.swept_low, &packet.swept_high}) {
    *count *= 100;
  }
  for (double& sector : packet.sectors) sector *= 100;
  const Evidence much = evidence_in(quiet_game(), packet);
  for (const double nats : {much.place, much.sector, much.sign}) CHECK(std::abs(nats) < 3.6);
}

TEST_CASE("evidence compares the likelihoods of both classes, outliers included") {
  const GameTraits game = quiet_game();
  const EvidencePacket packet = packet_of_puck();
  const Evidence evidence = evidence_in(game, packet);
  const auto nats = [&](const ClassLikelihoods& plain) {
    const ClassLikelihoods log = with_outliers(plain);
    return evidence.told * (log.puck - log.other);
  };
  CHECK(nats(place_likelihoods(packet, kAreas, 1, game, {})) == doctest::Approx(evidence.place));
  CHECK(nats(sector_likelihoods(packet, game, {})) == doctest::Approx(evidence.sector));
  CHECK(nats(sign_likelihoods(packet, game, {})) == doctest::Approx(evidence.sign));
}

TEST_CASE("half a contour speaks against a puck, however many events it has") {
  for (const double events : {10, 100, 1'000, 10'000}) {
    CAPTURE(events);
    EvidencePacket packet = packet_of_puck();
    packet.ring = 6 * events;
    packet.sectors = {events, events, events, 0, 0, 0, events, events, events};
    CHECK(evidence_in(quiet_game(), packet).sector < -1);
  }
}

TEST_CASE("what was learned of a game is forgotten by shares") {
  GameTraits game;
  for (int i = 0; i < 100; ++i) game.learn(packet_of_puck());
  CHECK(game.dark_share() + game.bright_share() > 0.3);
  CHECK(game.density() == doctest::Approx(28.0 / 20).epsilon(0.02));
  game.forget(1);
  CHECK(game.dark_share() + game.bright_share() == 0);
  CHECK(game.leading_share() == doctest::Approx(0.5));
}

TEST_CASE("what has moved by itself is no mark of the scene, until it has rested for long") {
  OwnMotion motion;
  CHECK(motion.mark() == 1);
  motion.pass(1, 1, 0.01);
  CHECK(motion.mark() == 1);
  for (int i = 0; i < 20; ++i) motion.pass(0.001, 0, 0.01);
  const double moved = motion.mark();
  CHECK(moved < 1e-3);
  motion.pass(0.1, 1, 0.01);
  CHECK(motion.mark() > moved);
  CHECK(motion.mark() < 0.01);
  motion.pass(1'000, 1, 0.01);
  CHECK(motion.mark() == 1);
}

TEST_CASE("belief in a puck is undone within some packets, however long it has lasted") {
  const BeliefRates rates;
  PuckBelief belief;
  for (int i = 0; i < 5'000; ++i) {
    belief.pass(0.001, 0, 1, 0, rates);
    belief.take(4);
  }
  CHECK(belief.odds() > 1e3);
  for (int i = 0; i < 8; ++i) {
    belief.pass(0.001, 0, 1, 0, rates);
    belief.take(-4);
  }
  CHECK(belief.odds() < 1);
}

TEST_CASE("a puck that something comes to cover is hidden rather than elsewhere") {
  const BeliefRates rates;
  PuckBelief belief(9);
  for (int i = 0; i < 10; ++i) {
    belief.pass(0.002, 1, 1, 0, rates);
    belief.take(-3);
  }
  CHECK(belief.seen_share() < 0.1);
  CHECK(belief.odds() > 1);
}

TEST_CASE(
    "a puck that falls silent is still believed seconds later, but not while it is seen "
    "elsewhere") {
  const BeliefRates rates;
  PuckBelief silent(6);
  PuckBelief doubtful(6);
  for (int i = 0; i < 300; ++i) {
    silent.pass(0.01, 0, 0, 0, rates);
    silent.take(0);
    doubtful.pass(0.01, 0, 0, 1, rates);
    doubtful.take(0);
  }
  CHECK(silent.odds() > 5);
  CHECK(doubtful.odds() < 0.1);
}

}  // namespace
}  // namespace puck
