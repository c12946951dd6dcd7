#pragma once

#include <cmath>
#include <cstdint>

#include "common/play/play_bridge.h"
#include "tests/support/test_camera.h"

namespace puck {

inline PuckTrack puck_at(double x, double y, double vx, double vy) {
  return {{{x, y}, {vx, vy}}, {}};
}

/// A bridge with a simulated clock, tracker and arm.
class BridgeBench {
 public:
  static constexpr std::int64_t kTrackerSession = 3001;
  static constexpr std::int64_t kArmSession = 1001;

  /// The clock of the tracker and the arm is ahead by `sender_ahead_us`, a known offset.
  explicit BridgeBench(const PlayBridgeParams& params = {}, std::int64_t sender_ahead_us = 0,
                       const std::optional<PinholeCamera>& camera = std::nullopt)
      : sender(ClockOffset{sender_ahead_us, 0}),
        bridge(params, test_camera(), TableGeometry{}, camera) {}

  std::int64_t sender_utime() const { return now.utime + sender->ahead_us; }

  /// A good estimate of a puck there for a test to modify, 300 µs old by its clock.
  PublishedEstimate estimate(const PuckState& puck) { return estimate(puck, test_camera()); }
  PublishedEstimate estimate(const PuckState& puck, const Homography& camera) {
    const Pixel pixel = *camera.to_image(puck.position);
    // The image's velocity, from the point a microsecond later.
    const Pixel next = *camera.to_image({puck.position.x_m + 1e-6 * puck.velocity.x_m_s,
                                         puck.position.y_m + 1e-6 * puck.velocity.y_m_s});
    PublishedEstimate message;
    message.utime = sender_utime() - 100;
    message.session = kTrackerSession;
    message.seq = next_estimate_seq_++;
    message.events_session = 1;
    message.newest_event.us = sensor_us() - 300;
    message.event_utime = sender_utime() - 300;
    message.state = TrackState::kTracking;
    message.position = pixel;
    message.velocity.x = (next.x - pixel.x) * 1e6;
    message.velocity.y = (next.y - pixel.y) * 1e6;
    message.covariance[0] = message.covariance[5] = 0.25;
    return message;
  }

  PublishedEstimate lost() {
    PublishedEstimate message = estimate({{1, 0}, {}});
    message.state = TrackState::kLost;
    message.position.reset();
    return message;
  }

  /// `command_session`: the session that the arm follows.
  void see_arm(std::int64_t command_session = 0, ArmActivity activity = ArmActivity::kIdle) {
    ArmState message;
    message.activity = activity;
    message.utime = sender_utime();
    message.session = kArmSession;
    message.seq = next_arm_seq_++;
    message.command.session = command_session;
    message.line_min_m = -0.3;
    message.line_max_m = 0.3;
    bridge.hear(message, now, sender);
  }

  /// An estimate each millisecond of a puck that begins there, for the length of the probation. No
  /// message is taken, and the arm is silent.
  void earn_trust(PuckTrack puck) {
    const PuckMotion motion(TableGeometry{});
    for (int i = 0; i < 20; ++i) {
      pass(1000);
      puck = motion.advance(puck, 0.001).track;
      bridge.hear(estimate(puck.state), now, sender);
    }
  }

  void pass(std::int64_t us) {
    now.utime += us;
    now.monotonic_us += us;
  }

  /// An estimate each millisecond of a puck that moves by `motion`, for `ms`, with an arm on the
  /// bus. Takes the messages that are due, and keeps the last of each.
  void play(const PuckMotion& motion, PuckTrack& puck, int ms) {
    for (int i = 0; i < ms; ++i) {
      pass(1000);
      puck = motion.advance(puck, 0.001).track;
      see_arm();
      bridge.hear(estimate(puck.state), now, sender);
      take();
    }
  }
  void take() {
    if (const auto due = bridge.next_command(now)) command = due, ++commands;
    if (const auto due = bridge.next_trajectory(now)) trajectory = due, ++trajectories;
    if (const auto due = bridge.next_game(now)) game = due, ++games;
  }

  /// The sensor was started 1.7e15 µs after 1970.
  std::int64_t sensor_us() const { return now.utime - 1'700'000'000'000'000; }

  HostNow now{1'700'000'005'000'000, 77'000'000};
  SenderClock sender;
  PlayBridge bridge;
  std::optional<ArmCommand> command;
  std::optional<TableTrajectory> trajectory;
  std::optional<GameState> game;
  int commands = 0;
  int trajectories = 0;
  int games = 0;

 private:
  std::int64_t next_estimate_seq_ = 0;
  std::int64_t next_arm_seq_ = 0;
};

}  // namespace puck
