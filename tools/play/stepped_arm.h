#pragma once

#include <cstdint>
#include <optional>

#include "common/control/arm_controller.h"
#include "common/events/timestamp.h"
#include "common/messages/clock_offset.h"
#include "common/messages/host_now.h"

namespace puck {

/// Sessions of the services in a loop without a bus.
inline constexpr std::int64_t kCameraSession = 1;
inline constexpr std::int64_t kTrackerSession = 2;
inline constexpr std::int64_t kBridgeSession = 3;
inline constexpr std::int64_t kArmSession = 4;

/// All services run on one host; its clocks start here at sensor time 0.
inline constexpr std::int64_t kStartUtime = 1'700'000'000'000'000;
inline constexpr std::int64_t kStartMonotonicUs = 1'000'000'000;
inline const SenderClock kSameClock = ClockOffset{};

constexpr HostNow host_time_of(Timestamp t) {
  return {kStartUtime + t.us, kStartMonotonicUs + t.us};
}

/// The arm as in its service: a step per millisecond, ARM_STATE at 500 Hz. One thread.
class SteppedArm {
 public:
  explicit SteppedArm(const ArmControllerParams& params) : arm_(params, kArmSession) {}

  ArmController& controller() { return arm_; }

  /// Makes all steps due by `now`.
  void step_until(Timestamp now) {
    for (; next_step_ <= now; next_step_ = next_step_ + kStepUs) {
      arm_.step(host_time_of(next_step_), kStepUs * 1e-6);
    }
  }
  /// ARM_STATE, if due.
  std::optional<ArmState> next_state(Timestamp now) {
    if (now < next_state_) return std::nullopt;
    next_state_ = next_state_ + kStatePeriodUs;
    ArmState state = arm_.state();
    state.utime = host_time_of(now).utime;
    state.session = kArmSession;
    state.seq = states_++;
    return state;
  }

 private:
  static constexpr std::int64_t kStepUs = 1000;
  static constexpr std::int64_t kStatePeriodUs = 2000;

  ArmController arm_;
  Timestamp next_step_;
  Timestamp next_state_;
  std::int64_t states_ = 0;
};

}  // namespace puck
