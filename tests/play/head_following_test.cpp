#include <cmath>
#include <cstdint>

#include <doctest/doctest.h>

#include "common/table/table_camera.h"
#include "tests/play/bridge_bench.h"

namespace puck {
namespace {

constexpr PinholeCamera kCamera{700, {320, 240}, {}};

// A bench whose camera turns to the right at 20 degrees a second.
class TurningBench {
 public:
  explicit TurningBench(const PlayBridgeParams& params = {}) : bench(params, 0, kCamera) {}

  static HeadPose pose_at(std::int64_t sensor_us) {
    return {static_cast<double>(sensor_us % 1'000'000) * 20e-6 - 3, 1, 0, 20, 0, 0};
  }
  void hear_head() {
    HeadState head{{0, 5001, next_seq_++}, pose_at(bench.sensor_us())};
    if (says_time) head.at = Timestamp{bench.sensor_us()};
    bench.bridge.hear(head, bench.now);
  }
  PublishedEstimate estimate(const PuckState& puck) {
    const std::int64_t then_us = bench.sensor_us() - 300;
    const auto seen_at = [&](std::int64_t us) {
      return TableCamera(test_camera(), kCamera).view_at(pose_at(us))->homography();
    };
    PublishedEstimate message = bench.estimate(puck, seen_at(then_us));
    // The turn moves it in the image, too.
    const Pixel next = *seen_at(then_us + 1000)
                            .to_image({puck.position.x_m + 1e-3 * puck.velocity.x_m_s,
                                       puck.position.y_m + 1e-3 * puck.velocity.y_m_s});
    message.velocity.x = (next.x - message.position->x) * 1e3;
    message.velocity.y = (next.y - message.position->y) * 1e3;
    return message;
  }
  // A puck at rest, for `ms`; HEAD every `head_ms`.
  void play(int ms, int head_ms) {
    for (int i = 0; i < ms; ++i) {
      bench.pass(1000);
      if (i % head_ms == 0) hear_head();
      bench.see_arm();
      bench.bridge.hear(estimate(kPuck), bench.now, bench.sender);
      bench.take();
    }
  }

  static constexpr PuckState kPuck{{1.2, 0.3}, {0, 0}};
  BridgeBench bench;
  bool says_time = true;

 private:
  std::int64_t next_seq_ = 0;
};

TEST_CASE("The puck keeps its place on the table while the head turns") {
  for (const int head_ms : {1, 5, 10}) {
    CAPTURE(head_ms);
    TurningBench turning;
    turning.play(200, head_ms);
    const BridgeBench& bench = turning.bench;
    REQUIRE(bench.trajectory);
    CHECK(bench.trajectory->head_known);
    REQUIRE(bench.trajectory->track);
    CHECK_FALSE(bench.trajectory->is_coasting);
    const PuckState& puck = bench.trajectory->track->state;
    CHECK(std::abs(puck.position.x_m - 1.2) < 1e-3);
    CHECK(std::abs(puck.position.y_m - 0.3) < 1e-3);
    CHECK(std::hypot(puck.velocity.x_m_s, puck.velocity.y_m_s) < 0.02);
    CHECK(bench.commands > 40);
    CHECK_FALSE(bench.bridge.is_blind_to_head());
  }
}

TEST_CASE("A HEAD without sensor time is treated as live") {
  TurningBench turning;
  turning.says_time = false;
  turning.play(200, 2);
  REQUIRE(turning.bench.trajectory);
  CHECK(turning.bench.trajectory->head_known);
  CHECK(std::abs(turning.bench.trajectory->track->state.position.y_m - 0.3) < 2e-3);
}

TEST_CASE("After HEAD falls silent the bridge commands nothing after 10 ms, until HEAD returns") {
  TurningBench turning;
  turning.play(100, 1);
  BridgeBench& bench = turning.bench;
  CHECK_FALSE(bench.bridge.is_blind_to_head());
  turning.play(1, 1);
  turning.play(20, 1000);
  // The first of them had a HEAD, nine more use its extrapolation.
  CHECK(bench.bridge.is_blind_to_head());
  CHECK(bench.bridge.gate().count(EstimateVerdict::kBlind) == 10);
  CHECK_FALSE(bench.trajectory->head_known);
  bench.command.reset();
  turning.play(50, 1000'000);
  CHECK(bench.bridge.is_blind_to_head());
  turning.play(10, 1);
  CHECK_FALSE(bench.bridge.is_blind_to_head());
  CHECK(bench.command);
}

TEST_CASE("A bridge that needs HEAD commands nothing before the first HEAD") {
  PlayBridgeParams params;
  params.needs_head = true;
  TurningBench turning(params);
  CHECK(turning.bench.bridge.is_blind_to_head());
  turning.bench.pass(1000);
  turning.bench.see_arm();
  turning.bench.bridge.hear(turning.estimate(TurningBench::kPuck), turning.bench.now,
                            turning.bench.sender);
  turning.bench.take();
  CHECK_FALSE(turning.bench.command);
  CHECK_FALSE(turning.bench.trajectory->head_known);
  turning.play(50, 1);
  CHECK(turning.bench.command);
}

TEST_CASE("A HEAD of another time than the estimates leaves the bridge without commands") {
  for (const std::int64_t us : {std::int64_t{0}, std::int64_t{-5}, INT64_MAX, INT64_MIN}) {
    CAPTURE(us);
    TurningBench turning;
    turning.play(20, 1);
    HeadState message;
    message.session = 5001;
    message.seq = 1000;
    message.at = Timestamp{us};
    turning.bench.bridge.hear(message, turning.bench.now);
    turning.bench.pass(20'000);
    turning.bench.bridge.hear(turning.estimate(TurningBench::kPuck), turning.bench.now,
                              turning.bench.sender);
    CHECK(turning.bench.bridge.is_blind_to_head());
  }
}

}  // namespace
}  // namespace puck
