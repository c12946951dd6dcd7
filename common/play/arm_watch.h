#pragma once

#include <cstdint>
#include <optional>

#include "common/messages/arm_state.h"
#include "common/messages/clock_offset.h"
#include "common/messages/host_now.h"
#include "common/messages/single_publisher.h"

namespace puck {

/// The commanded arm by its ARM_STATE, and the publisher that it obeys. One thread.
class ArmWatch {
 public:
  /// `max_clock_error_us`: limit for the age of a state's utime.
  explicit ArmWatch(std::int64_t max_clock_error_us) : max_clock_error_us_(max_clock_error_us) {}

  /// `sender`: the clock of the state's session. States that are not current are ignored.
  void hear(const ArmState& state, const HostNow& now, const SenderClock& sender);

  /// The newest state; null while no arm is heard.
  const ArmState* arm(const HostNow& now) const;
  /// Session of another publisher whose commands the arm has followed for 0.5 s; 0: none.
  std::int64_t other_commander(std::int64_t own_session, const HostNow& now) const;

 private:
  std::int64_t max_clock_error_us_;
  SinglePublisher publisher_;
  std::optional<ArmState> newest_;
  std::int64_t heard_us_ = 0;            // CLOCK_MONOTONIC
  std::int64_t commander_since_us_ = 0;  // CLOCK_MONOTONIC
};

}  // namespace puck
