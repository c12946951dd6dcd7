#include "common/play/play_bridge.h"

#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "tests/play/bridge_bench.h"

namespace puck {
namespace {

// A bench that has followed a puck across the table for 50 ms.
BridgeBench following() {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.5, 0.1, -1, 0.1);
  bench.play(PuckMotion(TableGeometry{}), puck, 50);
  REQUIRE(bench.command);
  return bench;
}

// Whether a command is due after the time between two commands.
bool commands_next(BridgeBench& bench) {
  bench.command.reset();
  bench.pass(5000);
  bench.see_arm();
  bench.take();
  return bench.command.has_value();
}

TEST_CASE("The bridge sends the arm to the crossing of a straight shot") {
  BridgeBench bench;
  const PuckMotion motion(TableGeometry{});
  PuckTrack puck = puck_at(1.8, -0.3, -2, 0.6);
  bench.play(motion, puck, 200);
  const Intercept truth = *InterceptPredictor(motion).predict(puck);
  REQUIRE(bench.command);
  CHECK(bench.command->mode == CommandMode::kFollow);
  CHECK(bench.command->target_m == doctest::Approx(truth.y_m).epsilon(0.1));
  CHECK(bench.command->target_normalised == doctest::Approx(bench.command->target_m / 0.3));
  CHECK(static_cast<double>(bench.command->arrive_in_us) * 1e-6 ==
        doctest::Approx(truth.in_s).epsilon(0.05));
  CHECK(bench.command->valid_for_us == 100'000);
  CHECK(bench.command->arm_session == BridgeBench::kArmSession);
  CHECK(bench.command->estimate.session == BridgeBench::kTrackerSession);
  CHECK(bench.command->estimate.seq >= 196);
}

TEST_CASE("The bridge sends the arm to the crossing of a bank shot") {
  BridgeBench bench;
  const PuckMotion motion(TableGeometry{});
  PuckTrack puck = puck_at(1.9, 0.2, -2.5, 2.0);
  bench.play(motion, puck, 100);
  const Intercept truth = *InterceptPredictor(motion).predict(puck);
  CHECK(truth.bounces == 1);
  CHECK(bench.trajectory->crossing->bounces == 1);
  CHECK(bench.command->target_m == doctest::Approx(truth.y_m).epsilon(0.2));
}

TEST_CASE("For a puck that will miss the goal the mallet waits at the post, not beyond") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.0, 0.45, -2, 0);
  bench.play(PuckMotion(TableGeometry{}), puck, 200);
  CHECK(bench.command->target_m == 0.2);
  CHECK(bench.command->target_normalised == doctest::Approx(0.2 / 0.3));
}

TEST_CASE("A target beyond the end of the arm's line is clamped to that end") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.0, 0.45, -2, 0);
  bench.play(PuckMotion(TableGeometry{}), puck, 200);
  ArmState narrow;
  narrow.utime = bench.sender_utime();
  narrow.session = BridgeBench::kArmSession;
  narrow.seq = 1'000'000;
  narrow.line_min_m = -0.1;
  narrow.line_max_m = 0.1;
  bench.pass(5000);
  bench.bridge.hear(narrow, bench.now, bench.sender);
  bench.take();
  CHECK(bench.command->target_m == 0.1);
  CHECK(bench.command->target_normalised == 1);
}

TEST_CASE(
    "The mallet moves part of the way to an uncertain crossing, all the way to a certain one") {
  const TableGeometry table;
  const Strategy strategy({.crossing_prior_m = 0.15}, table);
  const PuckTrack puck = puck_at(1.5, 0, -2, 0);
  Intercept crossing;
  crossing.y_m = 0.16;
  crossing.in_s = 0.7;
  crossing.sigma_y_m = 0.001;
  CHECK(strategy.decide(puck, crossing).y_m == doctest::Approx(0.16).epsilon(0.001));
  crossing.sigma_y_m = 0.15;
  CHECK(strategy.decide(puck, crossing).y_m == doctest::Approx(0.08));
  crossing.sigma_y_m = 1e6;
  CHECK(std::abs(strategy.decide(puck, crossing).y_m) < 1e-6);
  CHECK(strategy.decide(puck, crossing).arrive_in_s == 0.7);
}

TEST_CASE("After a save the mallet returns to the middle at once") {
  const Strategy strategy({}, TableGeometry{});
  CHECK(strategy.decide(puck_at(0.4, 0.3, 1.5, 0), std::nullopt).y_m == 0);
  CHECK(strategy.decide(puck_at(0.4, 0.3, 0, 0), std::nullopt).y_m == doctest::Approx(0.15));
}

TEST_CASE("A changed target is sent at once, an unchanged one at the usual rate") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.2, 0.1, 2, 0.1);
  bench.play(PuckMotion(TableGeometry{}), puck, 50);
  puck.state.velocity = {-8, 0.9};
  const int before = bench.commands;
  bench.play(PuckMotion(TableGeometry{}), puck, 24);
  CHECK(bench.commands - before > 24 / 4 + 2);
}

TEST_CASE("The mallet returns to the middle when the puck moves away") {
  // Rails with little restitution: the puck will not return within the horizon.
  PlayBridgeParams params;
  params.motion.rail_restitution = 0.1;
  BridgeBench bench(params);
  PuckTrack puck = puck_at(1.3, 0.3, 1.0, 0);
  bench.play(PuckMotion(TableGeometry{}, params.motion), puck, 100);
  REQUIRE(bench.command);
  CHECK(bench.command->target_m == 0);
}

TEST_CASE("The mallet shadows a puck at rest in the robot's half") {
  BridgeBench bench;
  PuckTrack puck = puck_at(0.7, 0.3, 0, 0);
  bench.play(PuckMotion(TableGeometry{}), puck, 100);
  REQUIRE(bench.command);
  CHECK(bench.command->target_m == doctest::Approx(0.15).epsilon(0.05));
}

TEST_CASE("Commands keep their rate and their validity") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.8, 0, -1, 0);
  bench.play(PuckMotion(TableGeometry{}), puck, 400);
  CHECK(bench.commands == 97);       // 250 Hz, except in the probation of 15 ms
  CHECK(bench.trajectories == 400);  // one an estimate
}

TEST_CASE("Without an arm there is no command; a new arm session is answered at once") {
  BridgeBench bench = following();
  bench.command.reset();
  bench.pass(600'000);
  bench.earn_trust(puck_at(1, 0, -1, 0));
  bench.take();
  CHECK_FALSE(bench.command);
  ArmState restarted;
  restarted.utime = bench.sender_utime();
  restarted.session = 4242;
  restarted.line_min_m = -0.3;
  restarted.line_max_m = 0.3;
  bench.bridge.hear(restarted, bench.now, bench.sender);
  bench.take();
  REQUIRE(bench.command);
  CHECK(bench.command->arm_session == 4242);
}

TEST_CASE(
    "With the tracker's clock hours away the bridge plays as well, and knows the estimates' age") {
  constexpr std::int64_t kHourUs = 3'600'000'000;
  const PuckMotion motion(TableGeometry{});
  std::optional<double> target_m;
  for (const std::int64_t ahead_us : {std::int64_t{0}, 7 * kHourUs, -7 * kHourUs}) {
    CAPTURE(ahead_us);
    BridgeBench bench({}, ahead_us);
    PuckTrack puck = puck_at(1.8, -0.3, -2, 0.6);
    bench.play(motion, puck, 200);
    REQUIRE(bench.command);
    // The age of an estimate moves the puck on: to the bit the same with any clocks.
    if (target_m) CHECK(bench.command->target_m == *target_m);
    target_m = bench.command->target_m;

    PublishedEstimate stale = bench.estimate({{1.4, 0.1}, {-1, 0.1}});
    *stale.event_utime -= 100'000;
    bench.bridge.hear(stale, bench.now, bench.sender);
    CHECK(bench.bridge.gate().count(EstimateVerdict::kStale) == 1);
    CHECK_FALSE(commands_next(bench));
  }
}

TEST_CASE("While the tracker's or the arm's clock is unknown, the bridge commands nothing") {
  BridgeBench bench;
  bench.sender = std::nullopt;
  for (int i = 0; i < 100; ++i) {
    bench.pass(1000);
    PublishedEstimate estimate;
    estimate.utime = bench.now.utime;
    estimate.session = BridgeBench::kTrackerSession;
    estimate.seq = i;
    bench.bridge.hear(estimate, bench.now, std::nullopt);
  }
  CHECK(bench.bridge.gate().count(EstimateVerdict::kClockUnknown) == 100);

  BridgeBench deaf = following();
  deaf.pass(600'000);
  ArmState unknown;
  unknown.utime = deaf.now.utime;
  unknown.session = 4242;
  unknown.line_min_m = -0.3;
  unknown.line_max_m = 0.3;
  deaf.command.reset();
  deaf.earn_trust(puck_at(1, 0, -1, 0));
  deaf.bridge.hear(unknown, deaf.now, std::nullopt);
  deaf.take();
  CHECK_FALSE(deaf.command);
}

TEST_CASE("An arm in a log is not answered in place of the live one") {
  BridgeBench bench = following();
  bench.pass(600'000);
  ArmState logged;
  logged.utime = bench.sender_utime() - 300'000;
  logged.session = 4242;
  logged.line_min_m = -0.3;
  logged.line_max_m = 0.3;
  bench.bridge.hear(logged, bench.now, bench.sender);
  bench.see_arm();
  bench.earn_trust(puck_at(1, 0, -1, 0));
  bench.command.reset();
  bench.take();
  REQUIRE(bench.command);
  CHECK(bench.command->arm_session == BridgeBench::kArmSession);
}

TEST_CASE("Commands end 100 ms after the last good estimate") {
  BridgeBench bench = following();
  bench.pass(90'000);
  CHECK(commands_next(bench));
  bench.pass(4'000);
  CHECK_FALSE(commands_next(bench));
}

TEST_CASE("Commands end at once on a newest estimate that is not acceptable") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<const char*, std::function<void(PublishedEstimate&)>>> spoils{
      {"lost", [](auto& e) { e.state = TrackState::kLost; }},
      {"searching", [](auto& e) { e.state = TrackState::kSearching; }},
      {"no position", [](auto& e) { e.position.reset(); }},
      {"stale events", [](auto& e) { *e.event_utime -= 100'000; }},
      {"off the table", [](auto& e) { e.position->y = 5; }},
      {"above the horizon", [](auto& e) { e.position->y = -170; }},
      {"too fast", [](auto& e) { e.velocity.x = 1e6; }},
      {"x not finite", [&](auto& e) { e.position->x = nan; }},
      {"covariance not finite", [&](auto& e) { e.covariance[7] = nan; }},
      {"no covariance", [](auto& e) { e.covariance[0] = -1; }},
      {"impossible time",
       [](auto& e) { e.newest_event.us = std::numeric_limits<std::int64_t>::max(); }},
  };
  for (const auto& spoiled : spoils) {
    CAPTURE(spoiled.first);
    BridgeBench bench = following();
    CHECK(commands_next(bench));
    PublishedEstimate estimate = bench.estimate({{1.4, 0.1}, {-1, 0.1}});
    spoiled.second(estimate);
    bench.bridge.hear(estimate, bench.now, bench.sender);
    CHECK_FALSE(commands_next(bench));
  }
}

TEST_CASE("A puck of the wrong size for its place is rejected, a missing size is accepted") {
  // A puck of 65 mm, 1.1 m from the camera's side of the table, at the place of the mirror image of
  // a much nearer puck.
  const TablePoint place{1.1, 0.2};
  const Pixel left = *test_camera().to_image({place.x_m, place.y_m - 0.0325});
  const Pixel right = *test_camera().to_image({place.x_m, place.y_m + 0.0325});
  const double true_px = std::hypot(right.x - left.x, right.y - left.y);
  const auto used = [&](double width_px) {
    BridgeBench bench;
    PublishedEstimate seen = bench.estimate({place, {}});
    seen.size.width = width_px;
    bench.bridge.hear(seen, bench.now, bench.sender);
    const std::int64_t doubted = bench.bridge.gate().count(EstimateVerdict::kWrongSize);
    CHECK(doubted + bench.bridge.gate().count(EstimateVerdict::kGood) == 1);
    return doubted == 0;
  };
  CHECK(used(0));
  CHECK(used(true_px));
  CHECK(used(1.9 * true_px));
  CHECK(used(true_px / 1.9));
  CHECK(!used(2.1 * true_px));
  CHECK(!used(true_px / 2.1));
  CHECK(!used(-true_px));
  CHECK(!used(std::numeric_limits<double>::quiet_NaN()));
}

TEST_CASE("Late, foreign and wrongly dated estimates are dropped, counted and change nothing") {
  BridgeBench bench = following();
  const auto expect_dropped = [&](PublishedEstimate estimate, EstimateVerdict verdict) {
    estimate.state = TrackState::kLost;  // ends the commands, if accepted
    bench.bridge.hear(estimate, bench.now, bench.sender);
    CHECK(bench.bridge.gate().count(verdict) == 1);
    CHECK(commands_next(bench));
  };
  PublishedEstimate late = bench.lost();
  late.seq = 10;
  expect_dropped(late, EstimateVerdict::kLate);
  PublishedEstimate foreign = bench.lost();
  foreign.session = 9;
  expect_dropped(foreign, EstimateVerdict::kOtherPublisher);
  PublishedEstimate old = bench.lost();
  old.utime -= 250'000;
  expect_dropped(old, EstimateVerdict::kClock);
}

TEST_CASE("A frozen estimate gives commands for 100 ms only, unless the puck rests") {
  for (const bool resting : {false, true}) {
    CAPTURE(resting);
    BridgeBench bench = following();
    PublishedEstimate frozen = bench.estimate({{1.45, 0.1}, {}});
    if (resting) frozen.resting = true;
    for (int i = 0; i < 300; ++i) {
      bench.pass(1000);
      bench.see_arm();
      PublishedEstimate again = bench.estimate({{1.45, 0.1}, {}});
      again.newest_event.us = frozen.newest_event.us;
      again.resting = resting;
      bench.bridge.hear(again, bench.now, bench.sender);
    }
    CHECK(commands_next(bench) == resting);
  }
}

TEST_CASE("A single jump is an outlier and does not send the arm away") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.8, 0.1, -1.5, 0);
  const PuckMotion motion(TableGeometry{});
  bench.play(motion, puck, 100);
  const double before_m = bench.command->target_m;
  bench.pass(500);
  bench.bridge.hear(bench.estimate({{0.5, -0.4}, {-1.5, 0}}), bench.now, bench.sender);
  CHECK(bench.bridge.outliers() == 1);
  CHECK(commands_next(bench));
  CHECK(bench.command->target_m == doctest::Approx(before_m).epsilon(0.05));
}

TEST_CASE("No commands while the head is turned, and the trajectory reports it") {
  BridgeBench bench = following();
  HeadState head;
  head.session = 5001;
  head.seq = 7;
  head.yaw_deg = 3;
  bench.bridge.hear(head, bench.now);
  CHECK(bench.bridge.is_blind_to_head());
  CHECK_FALSE(commands_next(bench));
  bench.pass(1000);
  bench.bridge.hear(bench.estimate({{1.4, 0.1}, {-1, 0.1}}), bench.now, bench.sender);
  bench.take();
  CHECK_FALSE(bench.trajectory->head_known);
  CHECK(bench.bridge.gate().count(EstimateVerdict::kBlind) == 1);
  head.yaw_deg = 0.1;
  head.seq = 8;
  bench.bridge.hear(head, bench.now);
  bench.bridge.hear(bench.estimate({{1.4, 0.1}, {-1, 0.1}}), bench.now, bench.sender);
  CHECK(commands_next(bench));
}

TEST_CASE("A late HEAD, or another robot's, does not count as the head's return") {
  BridgeBench bench = following();
  HeadState head;
  head.session = 5001;
  head.seq = 7;
  head.yaw_deg = 3;
  bench.bridge.hear(head, bench.now);
  head.yaw_deg = 0;
  head.seq = 6;
  bench.bridge.hear(head, bench.now);
  CHECK(bench.bridge.is_blind_to_head());
  head.session = 5002;
  head.seq = 8;
  bench.bridge.hear(head, bench.now);
  CHECK(bench.bridge.is_blind_to_head());
}

TEST_CASE("The trajectory gives the puck on the table in metres, and marks predictions") {
  BridgeBench bench;
  PuckTrack puck = puck_at(1.5, -0.2, -1, 0.5);
  bench.play(PuckMotion(TableGeometry{}), puck, 200);
  REQUIRE(bench.trajectory);
  REQUIRE(bench.trajectory->track);
  CHECK_FALSE(bench.trajectory->is_coasting);
  const PuckState& seen = bench.trajectory->track->state;
  CHECK(seen.position.x_m == doctest::Approx(puck.state.position.x_m).epsilon(0.01));
  CHECK(seen.position.y_m == doctest::Approx(puck.state.position.y_m).epsilon(0.05));
  CHECK(seen.velocity.x_m_s == doctest::Approx(puck.state.velocity.x_m_s).epsilon(0.05));
  CHECK(bench.trajectory->crossing);
  CHECK(bench.trajectory->line_x_m == doctest::Approx(0.15 + 0.05 + 0.0325));
  CHECK(bench.trajectory->path.size() == 26);

  const auto miss = [&](std::int64_t us) {
    bench.pass(us);
    bench.bridge.hear(bench.lost(), bench.now, bench.sender);
    bench.take();
    return *bench.trajectory;
  };
  const TableTrajectory coasting = miss(20'000);
  CHECK(coasting.track);
  CHECK(coasting.is_coasting);
  CHECK_FALSE(miss(90'000).track);
}

TEST_CASE("When the sensor's time restarts the filter does too") {
  BridgeBench bench = following();
  for (int i = 1; i <= 20; ++i) {
    bench.pass(1000);
    PublishedEstimate estimate = bench.estimate({{0.9, -0.2}, {}});
    estimate.events_session = 2;
    estimate.newest_event.us = 1000 * i;
    bench.bridge.hear(estimate, bench.now, bench.sender);
  }
  CHECK(commands_next(bench));
  CHECK(bench.bridge.outliers() == 0);
}

TEST_CASE("An overtaken estimate is used at its own time, and the track is the same") {
  const PuckMotion motion(TableGeometry{});
  const auto play = [&](bool swaps) {
    BridgeBench bench;
    PuckTrack puck = puck_at(1.8, -0.2, -2, 0.5);
    for (int i = 0; i < 50; ++i) {
      bench.pass(1000);
      puck = motion.advance(puck, 0.001).track;
      const PublishedEstimate first = bench.estimate(puck.state);
      bench.pass(1000);
      puck = motion.advance(puck, 0.001).track;
      const PublishedEstimate second = bench.estimate(puck.state);
      bench.bridge.hear(swaps && i > 0 ? second : first, bench.now, bench.sender);
      bench.bridge.hear(swaps && i > 0 ? first : second, bench.now, bench.sender);
      bench.take();
    }
    CHECK(bench.bridge.gate().count(EstimateVerdict::kBelated) == (swaps ? 49 : 0));
    CHECK(bench.bridge.gate().count(EstimateVerdict::kLate) == 0);
    return *bench.trajectory;
  };
  const TableTrajectory in_order = play(false);
  const TableTrajectory swapped = play(true);
  CHECK(swapped.track->state.position.x_m == in_order.track->state.position.x_m);
  CHECK(swapped.track->state.velocity.y_m_s == in_order.track->state.velocity.y_m_s);
  CHECK(swapped.track->covariance(2, 2) == in_order.track->covariance(2, 2));
}

TEST_CASE("An overtaken estimate of another sensor's time, or of future events, changes nothing") {
  for (const bool is_other_sensor : {true, false}) {
    CAPTURE(is_other_sensor);
    BridgeBench bench;
    const PuckMotion motion(TableGeometry{});
    PuckTrack puck = puck_at(1.5, 0.1, -0.2, 0);
    bench.play(motion, puck, 100);
    PublishedEstimate overtaken = bench.estimate(puck.state);
    bench.play(motion, puck, 1);
    if (is_other_sensor) {
      overtaken.events_session = 2;
      overtaken.newest_event.us -= 10'000;
    } else {
      overtaken.newest_event.us += 3'000'000;
    }
    bench.bridge.hear(overtaken, bench.now, bench.sender);
    CHECK(bench.bridge.gate().count(EstimateVerdict::kBelated) == 1);
    bench.commands = 0;
    bench.play(motion, puck, 200);
    CHECK(bench.commands >= 50);
    CHECK(bench.bridge.frozen() == 0);
    CHECK(bench.bridge.jumps() == 0);
  }
}

TEST_CASE("GAME is sent every 100 ms and on a change") {
  BridgeBench bench;
  bench.take();
  CHECK(bench.games == 1);
  for (int i = 0; i < 10; ++i) {
    bench.pass(100'000);
    bench.take();
  }
  CHECK(bench.games == 11);
  // A shot changes the phase and the counts between two periods.
  PuckTrack puck = puck_at(1.5, 0, -3, 0);
  bench.play(PuckMotion(TableGeometry{}), puck, 250);
  CHECK(bench.games >= 13);
  CHECK(bench.game->shots == 1);
}

TEST_CASE("Bridge parameters out of range are refused by name") {
  PlayBridgeParams params;
  params.valid_for_us = 200'000;
  CHECK_THROWS_AS(BridgeBench{params}, std::invalid_argument);
}

}  // namespace
}  // namespace puck
