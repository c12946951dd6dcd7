#pragma once

#include <cstdint>
#include <optional>

#include "common/messaging/channels.h"
#include "common/messaging/clock_offset.h"
#include "common/messaging/host_now.h"
#include "common/messaging/single_publisher.h"

namespace puck {

/// The arm that is commanded, by its ARM_STATE, and whom it obeys. One thread.
class ArmWatch {
 public:
  /// `max_clock_error_us`: of a state's utime, by its sender's clock.
  explicit ArmWatch(std::int64_t max_clock_error_us) : max_clock_error_us_(max_clock_error_us) {}

  /// `sender`: the clock of the state's session. An arm's word that is not of now is no arm.
  void hear(const arm_state_t& state, const HostNow& now, const SenderClock& sender);

  /// Its newest word; null while it is not heard.
  const arm_state_t* arm(const HostNow& now) const;
  /// The session of somebody else whose commands the arm has followed for a while; 0: nobody.
  std::int64_t other_commander(std::int64_t own_session, const HostNow& now) const;

 private:
  std::int64_t max_clock_error_us_;
  SinglePublisher publisher_;
  std::optional<arm_state_t> newest_;
  std::int64_t heard_us_ = 0;            // CLOCK_MONOTONIC
  std::int64_t commander_since_us_ = 0;  // CLOCK_MONOTONIC
};

}  // namespace puck
