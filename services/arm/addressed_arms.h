#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/messaging/channels.h"
#include "common/messaging/clock_offset.h"
#include "common/messaging/host_now.h"

namespace puck {

/// The arms that an operator's command is for, by their ARM_STATE, and whether each of them
/// confirms it. An arm counts while it speaks and what it says is of now: neither a log that is
/// played nor an arm that has died is asked, or can confirm. One thread.
class AddressedArms {
 public:
  /// `own_session`: of the operator's commands.
  AddressedArms(std::int8_t mode, std::int64_t own_session)
      : mode_(mode), own_session_(own_session) {}

  /// `sender`: the clock of the state's session.
  void hear(const arm_state_t& state, const HostNow& now, const SenderClock& sender);

  /// Their sessions: a reset answers each.
  std::vector<std::int64_t> sessions(const HostNow& now) const;
  /// There is one, and all say that they were stopped, or stopped once more, by this operator; or
  /// none is latched any more.
  bool confirm(const HostNow& now) const { return why_not(now).empty(); }
  /// Empty: they confirm.
  std::string why_not(const HostNow& now) const;

 private:
  struct Arm {
    arm_state_t state{};         // the newest
    std::int64_t heard_us = 0;   // CLOCK_MONOTONIC
    bool clock_is_good = false;  // it was of now
  };

  bool counts(const Arm& arm, const HostNow& now) const;
  bool confirms(const arm_state_t& state) const;

  std::int8_t mode_;
  std::int64_t own_session_;
  std::map<std::int64_t, Arm> arms_;  // by session
};

}  // namespace puck
