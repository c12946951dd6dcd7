#include "common/control/arm_controller.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <doctest/doctest.h>

#include "tests/control/arm_bench.h"
#include "tests/support/test_camera.h"

namespace puck {
namespace {

TEST_CASE("With commands and a live track the arm moves to its target and holds there") {
  ArmBench bench;
  bench.run(1);
  CHECK(bench.arm.state().activity == ArmActivity::kIdle);
  bench.play(100, 0.2);
  CHECK(bench.arm.state().activity == ArmActivity::kMoving);
  bench.play(500, 0.2);
  const ArmState state = bench.arm.state();
  CHECK(state.position_m == doctest::Approx(0.2).epsilon(0.01));
  CHECK(state.position_normalised == doctest::Approx(0.6667).epsilon(0.01));
  CHECK(state.activity == ArmActivity::kHolding);
  CHECK(state.reason.empty());
  CHECK(state.command.session == ArmBench::kBridgeSession);
  CHECK(state.command.seq == 599);
  CHECK(state.estimate.session == ArmBench::kTrackerSession);
}

TEST_CASE("The arm stops within its limits when the commands end") {
  ArmBench bench;
  bench.play(60, 0.3);
  CHECK(bench.arm.velocity_m_s() > 0.5);
  const double target_before = bench.arm.state().target_m;
  // Estimates continue, commands end. 100 ms until it brakes, and at most 1.5/20 + 3 * 20/2000 s to
  // rest from any state.
  for (int i = 0; i < 99; ++i) {
    bench.arm.hear(bench.estimate(), bench.now, bench.sender);
    bench.run(1);
  }
  CHECK(bench.arm.state().target_m == target_before);
  for (int i = 0; i < 106; ++i) {
    bench.arm.hear(bench.estimate(), bench.now, bench.sender);
    bench.run(1);
  }
  CHECK(bench.stands());
  CHECK(bench.arm.state().reason == "no fresh command");
  // The joints follow the set-point.
  bench.run(60);
  CHECK(bench.arm.state().activity == ArmActivity::kHolding);
}

TEST_CASE("An arm that ends comes to rest within its limits, whatever commands arrive") {
  ArmBench bench;
  bench.play(60, 0.3);
  REQUIRE(bench.arm.velocity_m_s() > 0.5);
  CHECK_FALSE(bench.arm.rests());
  bench.arm.end();
  // At most 1.5/20 + 3 * 20/2000 s to rest from any state.
  bench.play(106, 0.3);
  CHECK(bench.arm.rests());
  CHECK(bench.arm.state().reason == "shutting down");
  CHECK(bench.arm.state().faults == 0);
}

TEST_CASE("The arm stops when the track under good commands falls silent") {
  ArmBench bench;
  bench.play(40, 0.3);
  const auto command_only = [&](int ms) {
    for (int i = 0; i < ms; ++i) {
      bench.arm.hear(bench.command(i < 50 ? -0.3 : 0.3), bench.now, bench.sender);
      bench.run(1);
    }
  };
  command_only(101);
  CHECK(bench.arm.state().reason == "no live track");
  command_only(80);
  CHECK(bench.stands());
}

TEST_CASE("The arm stops at once when the tracker reports a lost puck") {
  ArmBench bench;
  bench.play(40, 0.3);
  for (int i = 0; i < 80; ++i) {
    PublishedEstimate lost = bench.estimate();
    lost.state = TrackState::kLost;
    bench.arm.hear(lost, bench.now, bench.sender);
    bench.arm.hear(bench.command(0.3), bench.now, bench.sender);
    bench.run(1);
    CHECK(bench.arm.state().reason == "no live track");
  }
  CHECK(bench.stands());
}

TEST_CASE("A repeated estimate is no track, unless the puck rests") {
  for (const bool resting : {false, true}) {
    ArmBench bench;
    const std::int64_t frozen_us = bench.now.monotonic_us;
    for (int i = 0; i < 300; ++i) {
      PublishedEstimate estimate = bench.estimate();
      estimate.newest_event.us = frozen_us;
      if (resting) estimate.resting = true;
      bench.arm.hear(estimate, bench.now, bench.sender);
      bench.arm.hear(bench.command(0.1), bench.now, bench.sender);
      bench.run(1);
    }
    CHECK((bench.arm.state().reason == "no live track") == !resting);
  }
}

TEST_CASE("Replayed, malformed and foreign estimates are no live track") {
  ArmBench bench;
  bench.run(SteadyStart::kReadings);
  PublishedEstimate old = bench.estimate();
  old.utime -= 300'000;
  bench.arm.hear(old, bench.now, bench.sender);
  PublishedEstimate malformed = bench.estimate();
  malformed.position->x = std::numeric_limits<double>::quiet_NaN();
  bench.arm.hear(malformed, bench.now, bench.sender);
  bench.arm.hear(bench.command(0.1), bench.now, bench.sender);
  bench.run(1);
  CHECK(bench.arm.state().reason == "no live track");
  CHECK(bench.arm.estimates(TrackWatch::Verdict::kClock) == 1);
  CHECK(bench.arm.estimates(TrackWatch::Verdict::kMalformed) == 1);

  bench.arm.hear(bench.estimate(), bench.now, bench.sender);
  ArmCommand command = bench.command(0.1);
  command.estimate.session = 4;
  bench.arm.hear(command, bench.now, bench.sender);
  bench.run(1);
  CHECK(bench.arm.state().reason ==
        "the command is based on another tracker than the one "
        "heard here");
  PublishedEstimate other = bench.estimate();
  other.session = 4;
  bench.arm.hear(other, bench.now, bench.sender);
  CHECK(bench.arm.estimates(TrackWatch::Verdict::kOtherPublisher) == 1);
}

TEST_CASE("With clocks hours apart the arm plays as well, and measures the same latency") {
  constexpr std::int64_t kHourUs = 3'600'000'000;
  for (const std::int64_t ahead_us : {std::int64_t{0}, 7 * kHourUs, -7 * kHourUs}) {
    CAPTURE(ahead_us);
    ArmBench bench({}, ahead_us);
    bench.play(600, 0.2);
    CHECK(bench.arm.position_m() == doctest::Approx(0.2).epsilon(0.01));
    CHECK(bench.arm.guard().refused() == 0);
    // The bench moves on by a millisecond between an estimate and the step that uses it.
    CHECK(bench.arm.state().estimate_to_motion_us == 1000);

    ArmCommand old = bench.command(-0.2);
    old.utime -= 200'001;
    bench.arm.hear(old, bench.now, bench.sender);
    CHECK(bench.arm.guard().refused(CommandRefusal::kOld) == 1);
  }
}

TEST_CASE("Estimates of a tracker with an unknown clock, or of a log's events, are no live track") {
  ArmBench bench;
  for (int i = 0; i < 50; ++i) {
    bench.arm.hear(bench.estimate(), bench.now, std::nullopt);
    bench.arm.hear(bench.command(0.2), bench.now, bench.sender);
    bench.run(1);
  }
  CHECK(bench.arm.estimates(TrackWatch::Verdict::kClockUnknown) == 50);
  CHECK(bench.arm.state().reason == "no live track");
  for (int i = 0; i < 50; ++i) {
    PublishedEstimate of_log = bench.estimate();
    of_log.is_live = false;
    bench.arm.hear(of_log, bench.now, bench.sender);
    bench.arm.hear(bench.command(0.2), bench.now, bench.sender);
    bench.run(1);
  }
  CHECK(bench.arm.state().reason == "no live track");
  CHECK(bench.arm.position_m() == 0);
}

TEST_CASE("A stop brakes, persists under good commands, and ends with an operator's reset") {
  ArmBench bench;
  bench.play(60, 0.3);
  bench.operate(CommandMode::kStop);
  bench.play(106, 0.3);
  CHECK(bench.stands());
  CHECK(bench.arm.state().activity == ArmActivity::kStopped);
  bench.play(200, 0.3);
  CHECK(bench.arm.state().reason == "stopped by an operator");
  const double stopped_at = bench.arm.position_m();
  bench.play(500, -0.3);
  CHECK(bench.arm.position_m() == doctest::Approx(stopped_at).epsilon(1e-6));
  bench.operate(CommandMode::kReset);
  bench.run(1);
  CHECK(bench.arm.state().activity == ArmActivity::kHolding);
  bench.play(500, -0.3);
  CHECK(bench.arm.position_m() == doctest::Approx(-0.3).epsilon(0.01));
}

TEST_CASE("Between a reset and the next step the arm reports its present state, not the latch") {
  ArmBench bench;
  bench.run(SteadyStart::kReadings);
  bench.operate(CommandMode::kStop);
  bench.run(1);
  CHECK(bench.arm.state().reason == "stopped by an operator");
  bench.operate(CommandMode::kReset);
  CHECK(bench.arm.state().reason == "not reset yet");
  bench.run(1);
  CHECK(bench.arm.state().reason == "no command yet");
}

TEST_CASE("The time from an estimate's publication to its set-point is measured") {
  ArmBench bench;
  bench.arm.hear(bench.estimate(), bench.now, bench.sender);
  bench.now.utime += 700;
  bench.now.monotonic_us += 700;
  bench.arm.hear(bench.command(0.1), bench.now, bench.sender);
  bench.run(5);
  CHECK(bench.arm.state().estimate_to_motion_us == 1700);
}

TEST_CASE("In mode follow the arm follows the puck's y, on the line and on the table only") {
  ArmControllerParams params;
  params.mode = ArmMode::kFollow;
  CHECK_THROWS_AS(ArmController(params, 1), std::invalid_argument);
  params.view = ArmView{test_camera(), {}};
  ArmBench bench(params);
  const auto see = [&](const Pixel pixel, int ms) {
    for (int i = 0; i < ms; ++i) {
      PublishedEstimate estimate = bench.estimate();
      estimate.position = pixel;
      bench.arm.hear(estimate, bench.now, bench.sender);
      bench.run(1);
    }
  };
  see(*test_camera().to_image({1, 0.12}), 600);
  CHECK(bench.arm.position_m() == doctest::Approx(0.12).epsilon(0.01));
  see(*test_camera().to_image({1.5, -0.5}), 600);
  CHECK(bench.arm.position_m() == doctest::Approx(-0.3).epsilon(0.01));
  see(*test_camera().to_image({1, 0.7}), 100);
  CHECK(bench.arm.state().reason == "the track is off the table");
  CHECK(bench.arm.position_m() == doctest::Approx(-0.3).epsilon(0.01));

  bench.arm.hear(bench.command(0), bench.now, bench.sender);
  CHECK(bench.arm.guard().refused(CommandRefusal::kFollowsItself) == 1);
  bench.operate(CommandMode::kStop);
  see(*test_camera().to_image({1, 0.12}), 100);
  CHECK(bench.arm.position_m() == doctest::Approx(-0.3).epsilon(0.01));
}

}  // namespace
}  // namespace puck
