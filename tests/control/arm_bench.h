#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "common/control/arm_controller.h"

namespace puck {

/// An arm controller with a simulated clock, bridge and tracker.
class ArmBench {
 public:
  static constexpr std::int64_t kArmSession = 1001;
  static constexpr std::int64_t kBridgeSession = 2001;
  static constexpr std::int64_t kTrackerSession = 3001;

  /// The clock of the bridge, the tracker and the operator is ahead by `sender_ahead_us`, a known
  /// offset.
  explicit ArmBench(const ArmControllerParams& params = {}, std::int64_t sender_ahead_us = 0,
                    std::unique_ptr<ArmBackEnd> back_end = nullptr)
      : sender(ClockOffset{sender_ahead_us, 0}), arm(params, kArmSession, std::move(back_end)) {}

  std::int64_t sender_utime() const { return now.utime + sender->ahead_us; }

  /// A good command for a test to modify.
  ArmCommand command(double target_m) {
    ArmCommand message;
    message.utime = sender_utime();
    message.session = kBridgeSession;
    message.seq = next_command_seq_++;
    message.mode = CommandMode::kFollow;
    message.target_m = target_m;
    message.target_normalised = target_m / 0.3;
    message.valid_for_us = 100'000;
    message.estimate.session = kTrackerSession;
    message.estimate.seq = next_estimate_seq_ - 1;
    message.arm_session = kArmSession;
    return message;
  }

  /// A good estimate for a test to modify.
  PublishedEstimate estimate() {
    PublishedEstimate message;
    message.utime = sender_utime();
    message.session = kTrackerSession;
    message.seq = next_estimate_seq_++;
    message.events_session = 1;
    message.newest_event.us = now.monotonic_us;
    message.event_utime = sender_utime();
    message.state = TrackState::kTracking;
    message.position = Pixel{320, 240};
    message.is_live = true;
    return message;
  }

  /// Sends an operator's stop or reset in a session of its own.
  void operate(CommandMode mode) {
    ArmCommand message = command(0);
    message.session = next_operator_session_++;
    message.seq = 0;
    message.mode = mode;
    message.from_operator = true;
    arm.hear(message, now, sender);
  }

  /// `ms` steps of 1 ms with nothing on the bus.
  void run(int ms) {
    for (int i = 0; i < ms; ++i) {
      now.utime += 1000;
      now.monotonic_us += 1000;
      arm.step(now, 0.001);
    }
  }

  /// `ms` steps of 1 ms with a fresh estimate and a command in each.
  void play(int ms, double target_m) {
    for (int i = 0; i < ms; ++i) {
      arm.hear(estimate(), now, sender);
      arm.hear(command(target_m), now, sender);
      run(1);
    }
  }

  bool stands() const { return arm.motion().line().is_at_rest(); }

  HostNow now{1'700'000'000'000'000, 5'000'000};
  SenderClock sender;
  ArmController arm;

 private:
  std::int64_t next_command_seq_ = 0;
  std::int64_t next_estimate_seq_ = 1;
  std::int64_t next_operator_session_ = 9001;
};

}  // namespace puck
