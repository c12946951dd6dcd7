// Time of the bridge from an estimate's receipt to its command, without the bus: one iteration is
// one estimate of a puck that moves to and fro across the table.

#include <cstdint>
#include <vector>

#include <benchmark/benchmark.h>

#include "common/play/play_bridge.h"
#include "tests/support/test_camera.h"

namespace puck {
namespace {

constexpr std::int64_t kStartUtime = 1'700'000'000'000'000;
constexpr std::int64_t kPeriodUs = 1'000;

// A tracker's estimates of a game of one player against the rails.
std::vector<PublishedEstimate> estimates() {
  const PuckMotionParams lossless{.damping_per_s = 0, .rail_restitution = 1, .rail_grip = 1};
  TableGeometry closed;
  closed.goal_width_m = 0;
  const PuckMotion motion(closed, lossless);
  const Homography camera = test_camera();
  PuckTrack puck{{{1.5, 0.1}, {-4, 1.3}}, {}};
  std::vector<PublishedEstimate> all(20'000);
  for (PublishedEstimate& e : all) {
    puck = {motion.advance(puck, kPeriodUs * 1e-6).track.state, {}};
    e = {};
    e.session = 3001;
    e.events_session = 1;
    e.state = TrackState::kTracking;
    e.position = *camera.to_image(puck.state.position);
    e.covariance[0] = e.covariance[5] = 0.25;
  }
  return all;
}

void estimate_to_command(benchmark::State& state) {
  const std::vector<PublishedEstimate> seen = estimates();
  PlayBridge bridge({}, test_camera(), TableGeometry{});
  const SenderClock clock = ClockOffset{};
  HostNow now{kStartUtime, 1'000'000};
  std::int64_t seq = 0;
  std::int64_t commands = 0;
  PublishedEstimate estimate;
  for (auto _ : state) {
    now.utime += kPeriodUs;
    now.monotonic_us += kPeriodUs;
    if (seq % 100 == 0) {
      ArmState arm;
      arm.utime = now.utime;
      arm.session = 1001;
      arm.seq = seq;
      arm.line_min_m = -0.3;
      arm.line_max_m = 0.3;
      bridge.hear(arm, now, clock);
    }
    estimate = seen[static_cast<std::size_t>(seq) % seen.size()];
    estimate.seq = seq++;
    estimate.utime = now.utime - 100;
    estimate.event_utime = now.utime - 300;
    estimate.newest_event.us = now.monotonic_us - 300;
    bridge.hear(estimate, now, clock);
    if (bridge.next_command(now)) ++commands;
  }
  if (seq > 1000 && 10 * commands < seq) state.SkipWithError("the bridge did not command");
}

BENCHMARK(estimate_to_command)->Name("bridge_estimate/ours");

}  // namespace
}  // namespace puck
