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
  CHECK(bench.arm.state().state == arm_state_t::STATE_IDLE);
  bench.play(100, 0.2);
  CHECK(bench.arm.state().state == arm_state_t::STATE_MOVING);
  bench.play(500, 0.2);
  const arm_state_t state = bench.arm.state();
  CHECK(state.position_m == doctest::Approx(0.2).epsilon(0.01));
  CHECK(state.position_normalised == doctest::Approx(0.6667).epsilon(0.01));
  CHECK(state.state == arm_state_t::STATE_HOLDING);
  CHECK(state.reason.empty());
  CHECK(state.command_session == ArmBench::kBridgeSession);
  CHECK(state.command_seq == 599);
  CHECK(state.estimate_session == ArmBench::kTrackerSession);
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
  CHECK(bench.arm.state().state == arm_state_t::STATE_HOLDING);
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
    puck_estimate_t lost = bench.estimate();
    lost.state = puck_estimate_t::STATE_LOST;
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
      puck_estimate_t estimate = bench.estimate();
      estimate.sensor_us = frozen_us;
      if (resting) estimate.flags |= puck_estimate_t::FLAG_RESTING;
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
  puck_estimate_t old = bench.estimate();
  old.utime -= 300'000;
  bench.arm.hear(old, bench.now, bench.sender);
  puck_estimate_t malformed = bench.estimate();
  malformed.x_px = std::numeric_limits<double>::quiet_NaN();
  bench.arm.hear(malformed, bench.now, bench.sender);
  bench.arm.hear(bench.command(0.1), bench.now, bench.sender);
  bench.run(1);
  CHECK(bench.arm.state().reason == "no live track");
  CHECK(bench.arm.estimates(TrackWatch::Verdict::kClock) == 1);
  CHECK(bench.arm.estimates(TrackWatch::Verdict::kMalformed) == 1);

  bench.arm.hear(bench.estimate(), bench.now, bench.sender);
  arm_command_t command = bench.command(0.1);
  command.estimate_session = 4;
  bench.arm.hear(command, bench.now, bench.sender);
  bench.run(1);
  CHECK(bench.arm.state().reason ==
        "the command is based on another tracker than the one "
        "heard here");
  puck_estimate_t other = bench.estimate();
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

    arm_command_t old = bench.command(-0.2);
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
    puck_estimate_t of_log = bench.estimate();
    of_log.flags = puck_estimate_t::FLAG_POSITION;
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
  bench.operate(arm_command_t::MODE_STOP);
  bench.play(106, 0.3);
  CHECK(bench.stands());
  CHECK(bench.arm.state().state == arm_state_t::STATE_STOPPED);
  bench.play(200, 0.3);
  CHECK(bench.arm.state().reason == "stopped by an operator");
  const double stopped_at = bench.arm.position_m();
  bench.play(500, -0.3);
  CHECK(bench.arm.position_m() == doctest::Approx(stopped_at).epsilon(1e-6));
  bench.operate(arm_command_t::MODE_RESET);
  bench.run(1);
  CHECK(bench.arm.state().state == arm_state_t::STATE_HOLDING);
  bench.play(500, -0.3);
  CHECK(bench.arm.position_m() == doctest::Approx(-0.3).epsilon(0.01));
}

TEST_CASE("Between a reset and the next step the arm reports its present state, not the latch") {
  ArmBench bench;
  bench.run(SteadyStart::kReadings);
  bench.operate(arm_command_t::MODE_STOP);
  bench.run(1);
  CHECK(bench.arm.state().reason == "stopped by an operator");
  bench.operate(arm_command_t::MODE_RESET);
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
      puck_estimate_t estimate = bench.estimate();
      estimate.x_px = pixel.x;
      estimate.y_px = pixel.y;
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
  bench.operate(arm_command_t::MODE_STOP);
  see(*test_camera().to_image({1, 0.12}), 100);
  CHECK(bench.arm.position_m() == doctest::Approx(-0.3).epsilon(0.01));
}

}  // namespace
}  // namespace puck
