#pragma once

#include <cstdint>
#include <deque>
#include <optional>

#include "common/play/play_bridge.h"
#include "common/simulation/random.h"
#include "common/simulation/simulated_arm.h"
#include "common/simulation/table_game.h"
#include "tests/support/test_camera.h"

namespace puck {

/// What a tracker does to the truth.
struct TrackerErrors {
  double sigma_px = 0;            ///< Of a position; errors live for 2 ms.
  double sigma_px_s = 0;          ///< Of a velocity.
  double losses_per_s = 0;        ///< The puck is lost so often, for up to 80 ms …
  double lost_at_hit = 0;         ///< … and at this share of the times its way changes at once.
  double strays_per_s = 0;        ///< Single estimates that are somewhere else.
  std::int64_t delay_us = 1'000;  ///< From the light to the bridge.
  std::int64_t period_us = 1'000;
};

/// The simulated game, a tracker that sees the truth but for its errors, a bridge and an arm: the
/// loop closed without a camera, step by step.
class PlayLoop {
 public:
  PlayLoop(const SimulationParams& world, const TrackerErrors& errors,
           const PlayBridgeParams& bridge = {});

  void run(double seconds);

  const GameCounts& truth() const { return game_.counts(); }
  const GameBelief& belief() const { return bridge_.game(); }
  const PlayBridge& bridge() const { return bridge_; }
  std::int64_t commands() const { return bridge_.commands(); }
  const std::optional<DiscState>& puck() const { return game_.puck(); }
  double arm_m() const { return arm_.position_m(); }

 private:
  void see(const std::optional<DiscState>& puck);
  void hear();

  static constexpr std::int64_t kStartUtime = 1'700'000'000'000'000;
  HostNow now() const { return {kStartUtime + t_us_, 1'000'000 + t_us_}; }

  TrackerErrors errors_;
  TableGame game_;
  Homography camera_ = test_camera();
  PlayBridge bridge_;
  SimulatedArm arm_;
  Random random_;
  std::int64_t t_us_ = 0;
  std::int64_t seq_ = 0;
  std::int64_t lost_until_us_ = 0;
  std::int64_t command_until_us_ = 0;
  TableVelocity last_velocity_;
  Pixel error_px_;
  std::deque<puck_estimate_t> on_the_way_;
};

}  // namespace puck
