#include "common/play/track_probation.h"

#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tests/play/bridge_bench.h"

namespace puck {
namespace {

// Shows an estimate each millisecond for `ms`, made by `look` from the true puck. Returns the
// number of commands sent meanwhile.
int commands_of(BridgeBench& bench, PuckTrack& puck, int ms,
                const std::function<void(PublishedEstimate&, int)>& look) {
  const PuckMotion motion(TableGeometry{});
  const int before = bench.commands;
  for (int i = 0; i < ms; ++i) {
    bench.pass(1000);
    puck = motion.advance(puck, 0.001).track;
    bench.see_arm();
    PublishedEstimate estimate = bench.estimate(puck.state);
    look(estimate, i);
    bench.bridge.hear(estimate, bench.now, bench.sender);
    bench.take();
  }
  return bench.commands - before;
}

int commands_of(BridgeBench& bench, PuckTrack& puck, int ms) {
  return commands_of(bench, puck, ms, [](PublishedEstimate&, int) {});
}

void move_to(PublishedEstimate& estimate, const TablePoint& place) {
  estimate.position = test_camera().to_image(place);
}

TEST_CASE("A new track moves the arm after its probation") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.5, 0.1, -1, 0.1);
  CHECK(commands_of(bench, puck, 15) == 0);
  CHECK(commands_of(bench, puck, 20) >= 4);
}

TEST_CASE("A hit starts no new track: the commands continue") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.3, 0.1, 2, 0.1);
  commands_of(bench, puck, 50);
  puck.state.velocity = {-8, 0.5};
  // Without the time in which a hit looks like outliers.
  CHECK(commands_of(bench, puck, 40) >= 8);
  CHECK(bench.bridge.probation().leaps() == 0);
  const double at_line_y_m = puck.state.position.y_m + 0.5 / 8 * (puck.state.position.x_m - 0.2325);
  CHECK(bench.command->target_m == doctest::Approx(at_line_y_m).epsilon(0.1));
}

TEST_CASE("A shot whose hit was hidden by the mallet moves the arm at once") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.4, -0.2, 0, 0);
  commands_of(bench, puck, 50);
  const auto at_mallet = [&](PublishedEstimate& estimate, int ms) {
    move_to(estimate, {1.4 + 0.005 * ms, -0.2});
  };
  commands_of(bench, puck, 16, at_mallet);
  puck.state = {{1.37, -0.197}, {-10, 1}};
  CHECK(commands_of(bench, puck, 20) >= 4);
  CHECK(bench.bridge.probation().leaps() == 0);
  CHECK(bench.bridge.jumps() == 0);
}

TEST_CASE("A track with an impossible jump goes through probation again, and is counted") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.5, 0.3, -1, 0);
  commands_of(bench, puck, 50);
  puck.state.position.y_m = -0.3;
  // The old track coasts until the filter gives it up; then comes the probation of the new one.
  while (bench.bridge.probation().leaps() == 0 && commands_of(bench, puck, 1) < 50) {
    REQUIRE(puck.state.position.x_m > 1.3);
  }
  CHECK(commands_of(bench, puck, 14) == 0);
  CHECK(commands_of(bench, puck, 20) >= 4);
  CHECK(bench.command->target_m < -0.03);
}

TEST_CASE("A tracker that jumps to and fro never moves the arm, at any stated certainty") {
  for (const int every_ms : {1, 3, 8, 14}) {
    CAPTURE(every_ms);
    BridgeBench bench;
    PuckTrack puck = puck_at(1.8, 0.3, -1, 0);
    int heard = 0;
    const auto mirror = [&](PublishedEstimate& estimate, int) {
      estimate.covariance[0] = estimate.covariance[5] = 1e-12;
      if (heard++ / every_ms % 2 == 1) estimate.position->x = 640 - estimate.position->x;
    };
    commands_of(bench, puck, 100, mirror);
    CHECK(commands_of(bench, puck, 400, mirror) == 0);
    CHECK(bench.bridge.untrusted() > 100);
  }
}

TEST_CASE("A velocity that contradicts the positions ends the commands, until it agrees again") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.8, 0.3, -1.5, 0);
  commands_of(bench, puck, 50);
  const auto reverse = [](PublishedEstimate& estimate, int) {
    estimate.velocity.x *= -1;
    estimate.velocity.y *= -1;
  };
  commands_of(bench, puck, 40, reverse);
  CHECK(commands_of(bench, puck, 100, reverse) == 0);
  CHECK(bench.bridge.probation().contradictions() == 1);
  CHECK(bench.bridge.probation().doubt() == TrackProbation::Doubt::kContradicts);
  CHECK(commands_of(bench, puck, 40) > 0);
}

TEST_CASE("A constant position with a stated velocity ends the commands") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.8, 0.3, -4, 0);
  commands_of(bench, puck, 50);
  const TablePoint held = puck.state.position;
  const auto hold = [&](PublishedEstimate& estimate, int) { move_to(estimate, held); };
  commands_of(bench, puck, 80, hold);
  CHECK(commands_of(bench, puck, 60, hold) == 0);
}

TEST_CASE("A tracker without velocities is accepted") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.8, 0.3, -1.5, 0);
  CHECK(commands_of(bench, puck, 200, [](PublishedEstimate& estimate, int) {
          estimate.velocity.x = estimate.velocity.y = 0;
        }) > 30);
}

TEST_CASE("The same estimate under new numbers is counted and moves the arm for 100 ms only") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.8, 0.3, -1, 0);
  commands_of(bench, puck, 50);
  const PublishedEstimate frozen = bench.estimate(puck.state);
  const auto freeze = [&](PublishedEstimate& estimate, int) {
    move_to(estimate, {1.75, 0.3});
    estimate.newest_event.us = frozen.newest_event.us;
  };
  commands_of(bench, puck, 105, freeze);
  CHECK(commands_of(bench, puck, 200, freeze) == 0);
  CHECK(bench.bridge.frozen() > 250);
}

TEST_CASE("Sensor time that runs ahead of the clock, or to and fro, is never accepted for long") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.8, 0.3, -1, 0);
  commands_of(bench, puck, 50);
  const auto leap = [](PublishedEstimate& estimate, int i) {
    if (i % 7 == 0) estimate.newest_event.us += 3'600'000'000;
  };
  commands_of(bench, puck, 10, leap);
  CHECK(commands_of(bench, puck, 300, leap) == 0);
}

TEST_CASE("An estimate of future events, or one with a huge variance, is implausible") {
  struct Spoil {
    const char* name;
    std::function<void(PublishedEstimate&)> spoil;
  };
  const std::vector<Spoil> spoils{
      {"events to come", [](auto& e) { *e.event_utime += 200'000; }},
      {"the last of all times",
       [](auto& e) { e.event_utime = std::numeric_limits<std::int64_t>::max(); }},
      {"unsure of the place", [](auto& e) { e.covariance[0] = 1e9; }},
      {"beyond numbers", [](auto& e) { e.covariance[5] = 1e308; }},
  };
  for (const Spoil& spoilt : spoils) {
    CAPTURE(spoilt.name);
    BridgeBench bench;
    PuckTrack puck = puck_at(1.8, 0.3, -1, 0);
    commands_of(bench, puck, 50);
    CHECK(commands_of(bench, puck, 100, [&](PublishedEstimate& e, int) { spoilt.spoil(e); }) == 0);
    CHECK(bench.bridge.gate().count(EstimateVerdict::kImplausible) == 100);
  }
}

TEST_CASE("Of two trackers one is followed, the other is counted and causes no motion") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.8, 0.3, -1, 0);
  commands_of(bench, puck, 50);
  const double target_m = bench.command->target_m;
  for (int i = 0; i < 100; ++i) {
    commands_of(bench, puck, 1);
    PublishedEstimate other = bench.estimate({{0.5, -0.3}, {-1, 0}});
    other.session = 9;
    bench.bridge.hear(other, bench.now, bench.sender);
  }
  CHECK(bench.bridge.gate().count(EstimateVerdict::kOtherPublisher) == 100);
  CHECK(bench.command->target_m == doctest::Approx(target_m).epsilon(0.05));
}

TEST_CASE("A bridge notices that the arm follows another bridge") {
  constexpr std::int64_t kOwn = 2001;
  BridgeBench bench;
  const auto arm_follows = [&](std::int64_t session, int ms,
                               ArmActivity activity = ArmActivity::kMoving) {
    for (int i = 0; i < ms; ++i) {
      bench.pass(1000);
      bench.see_arm(session, activity);
    }
    return bench.bridge.other_commander(kOwn, bench.now);
  };
  CHECK(arm_follows(0, 1000) == 0);
  CHECK(arm_follows(kOwn, 1000) == 0);
  CHECK(arm_follows(77, 400) == 0);
  CHECK(arm_follows(77, 200) == 77);
  CHECK(arm_follows(kOwn, 1) == 0);
  // A bridge that stopped the arm does not count as followed.
  CHECK(arm_follows(78, 600) == 78);
  CHECK(arm_follows(78, 600, ArmActivity::kStopped) == 0);
}

}  // namespace
}  // namespace puck
