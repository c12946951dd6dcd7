#include <cmath>
#include <cstdint>
#include <limits>

#include <doctest/doctest.h>

#include "common/control/arm_controller.h"
#include "tests/control/arm_bench.h"
#include "tests/support/test_camera.h"

namespace puck {
namespace {

// An arm that follows the puck straight from ESTIMATE.
class FollowBench : public ArmBench {
 public:
  FollowBench() : ArmBench(params()) {}

  void see(const TablePoint& place) { see(*test_camera().to_image(place)); }
  void see(const Pixel& pixel) {
    PublishedEstimate message = estimate();
    message.position = pixel;
    // A wrong tracker claims certainty.
    message.score = 1;
    arm.hear(message, now, sender);
    run(1);
  }
  double target_m() const { return arm.motion().line().target(); }

 private:
  static ArmControllerParams params() {
    ArmControllerParams params;
    params.mode = ArmMode::kFollow;
    params.view = ArmView{test_camera(), {}};
    return params;
  }
};

TEST_CASE("Direct mode predicts nothing: its target is the puck's position at any speed") {
  FollowBench bench;
  bench.run(SteadyStart::kReadings);
  for (int i = 0; i < 200; ++i) {
    const double y_m = -0.2 + 0.002 * i;
    bench.see(TablePoint{1.5 - 0.005 * i, y_m});
    REQUIRE(bench.target_m() == doctest::Approx(y_m).epsilon(1e-6));
  }
  CHECK(bench.arm.jumped_estimates() == 0);
}

TEST_CASE("A jump of the puck stops the arm for a while; a persistent new place is followed") {
  FollowBench bench;
  for (int i = 0; i < 400; ++i) bench.see(TablePoint{1, 0.2});
  CHECK(bench.arm.position_m() == doctest::Approx(0.2));
  for (int i = 0; i < 19; ++i) {
    bench.see(TablePoint{1, -0.2});
    REQUIRE(bench.arm.state().reason == "the track jumps");
  }
  CHECK(bench.arm.jumped_estimates() == 1);
  CHECK(bench.arm.position_m() == doctest::Approx(0.2));
  for (int i = 0; i < 600; ++i) bench.see(TablePoint{1, -0.2});
  CHECK(bench.arm.position_m() == doctest::Approx(-0.2));
}

TEST_CASE("A puck that alternates with its mirror image causes no motion") {
  FollowBench bench;
  for (int i = 0; i < 200; ++i) bench.see(TablePoint{1, 0.1});
  const double before_m = bench.arm.motion().line().state().position;
  for (int i = 0; i < 1000; ++i) bench.see(TablePoint{1, i % 10 < 5 ? -0.1 : 0.1});
  CHECK(bench.arm.motion().line().state().position == doctest::Approx(before_m).epsilon(0.05));
  CHECK(bench.arm.state().reason == "the track jumps");
  CHECK(bench.arm.jumped_estimates() > 190);
}

TEST_CASE("Nor does it if the puck is lost or off the table in between") {
  for (const bool is_lost : {true, false}) {
    CAPTURE(is_lost);
    FollowBench bench;
    for (int i = 0; i < 200; ++i) bench.see(TablePoint{1, 0.1});
    const double before_m = bench.arm.motion().line().state().position;
    for (int i = 0; i < 1000; ++i) {
      if (i % 10 != 0) {
        bench.see(TablePoint{1, i % 20 < 10 ? -0.1 : 0.1});
      } else if (is_lost) {
        PublishedEstimate lost = bench.estimate();
        lost.state = TrackState::kLost;
        bench.arm.hear(lost, bench.now, bench.sender);
        bench.run(1);
      } else {
        bench.see(TablePoint{1, 0.9});
      }
    }
    CHECK(bench.arm.motion().line().state().position == doctest::Approx(before_m).epsilon(0.05));
    CHECK(bench.arm.jumped_estimates() > 90);
  }
}

TEST_CASE("Pucks off the table or without a position are counted and cause no motion") {
  FollowBench bench;
  for (int i = 0; i < 100; ++i) bench.see(TablePoint{1, 0.9});
  CHECK(bench.arm.off_table_estimates() == 100);
  CHECK(bench.arm.state().reason == "the track is off the table");
  for (int i = 0; i < 100; ++i) bench.see(Pixel{1e300, -1e300});
  CHECK(bench.arm.off_table_estimates() == 200);
  bench.see(Pixel{std::numeric_limits<double>::quiet_NaN(), 0});
  CHECK(bench.arm.estimates(TrackWatch::Verdict::kMalformed) == 1);
  CHECK(bench.arm.motion().line().state().position == doctest::Approx(0));
}

TEST_CASE("A past or future estimate of a moving puck causes no motion, of a resting one it may") {
  for (const std::int64_t off_us : {-60'000'000L, -200'000L, 200'000L, 60'000'000L}) {
    for (const bool rests : {false, true}) {
      CAPTURE(off_us);
      CAPTURE(rests);
      FollowBench bench;
      for (int i = 0; i < 300; ++i) {
        PublishedEstimate estimate = bench.estimate();
        *estimate.event_utime += off_us;
        if (rests) estimate.resting = true;
        bench.arm.hear(estimate, bench.now, bench.sender);
        bench.run(1);
      }
      CHECK((bench.arm.state().reason == "no live track") == !rests);
      CHECK(bench.arm.estimates(TrackWatch::Verdict::kStale) == (rests ? 0 : 300));
    }
  }
}

TEST_CASE("A repeated frozen estimate is counted, and stops the arm") {
  ArmBench bench;
  bench.play(50, 0.3);
  const PublishedEstimate frozen = bench.estimate();
  for (int i = 0; i < 300; ++i) {
    PublishedEstimate again = frozen;
    again.seq = frozen.seq + i;
    again.utime = bench.sender_utime();
    bench.arm.hear(again, bench.now, bench.sender);
    bench.arm.hear(bench.command(0.3), bench.now, bench.sender);
    bench.run(1);
  }
  CHECK(bench.arm.frozen_estimates() > 90);
  CHECK(bench.arm.frozen_estimates() + bench.arm.estimates(TrackWatch::Verdict::kStale) == 299);
  CHECK(bench.stands());
  CHECK(bench.arm.state().reason == "no live track");
}

TEST_CASE("Of two bridges with opposite targets one is obeyed, and the arm never trembles") {
  ArmBench bench;
  ArmCommand other = bench.command(0);
  other.session = 77;
  other.seq = 0;
  for (int i = 0; i < 400; ++i) {
    bench.arm.hear(bench.estimate(), bench.now, bench.sender);
    bench.arm.hear(bench.command(0.25), bench.now, bench.sender);
    other.seq += 1;
    other.utime = bench.sender_utime();
    other.target_m = -0.25;
    other.estimate.seq += 1;
    bench.arm.hear(other, bench.now, bench.sender);
    bench.run(1);
    REQUIRE(bench.arm.motion().line().state().velocity >= 0);
  }
  CHECK(bench.arm.position_m() == doctest::Approx(0.25));
  CHECK(bench.arm.guard().refused(CommandRefusal::kOtherPublisher) == 400);
}

TEST_CASE("While a tracker restarts the arm rests, until bridge and arm follow the new one") {
  ArmBench bench;
  bench.play(300, 0.1);
  const auto say = [&](std::int64_t tracker, std::int64_t rests_on, double target_m) {
    PublishedEstimate estimate = bench.estimate();
    estimate.session = tracker;
    bench.arm.hear(estimate, bench.now, bench.sender);
    ArmCommand command = bench.command(target_m);
    command.estimate.session = rests_on;
    bench.arm.hear(command, bench.now, bench.sender);
    bench.run(1);
  };
  // A tracker is replaced only after half a second of silence.
  for (int i = 0; i < 490; ++i) say(4001, ArmBench::kTrackerSession, 0.3);
  CHECK(bench.arm.estimates(TrackWatch::Verdict::kOtherPublisher) == 490);
  CHECK(bench.arm.state().reason == "no live track");
  const double stands_m = bench.arm.motion().line().state().position;
  for (int i = 0; i < 50; ++i) say(4001, ArmBench::kTrackerSession, 0.3);
  CHECK(bench.arm.state().reason ==
        "the command is based on another tracker than the one "
        "heard here");
  CHECK(bench.arm.motion().line().state().position == stands_m);
  for (int i = 0; i < 400; ++i) say(4001, 4001, -0.1);
  CHECK(bench.arm.position_m() == doctest::Approx(-0.1));
}

TEST_CASE("Targets that jump between the ends at every step move the arm within its limits") {
  ArmBench bench;
  for (int i = 0; i < 2000; ++i) {
    bench.arm.hear(bench.estimate(), bench.now, bench.sender);
    bench.arm.hear(bench.command(i % 2 == 0 ? 0.3 : -0.3), bench.now, bench.sender);
    bench.run(1);
    const MotionState& state = bench.arm.motion().line().state();
    REQUIRE(std::abs(state.position) <= 0.3);
    REQUIRE(std::abs(state.velocity) <= 1.5 + 1e-9);
    REQUIRE(std::abs(state.acceleration) <= 20 + 1e-9);
  }
  CHECK(bench.arm.state().faults == 0);
}

}  // namespace
}  // namespace puck
