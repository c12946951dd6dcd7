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
/// confirms it. An arm is heard while it speaks, unless its clock is known and what it says is not
/// of now: that is a log that is played. One whose clock is not known cannot be told from a log: it
/// must confirm with the others, but a word of its own confirms nothing, unless it names this
/// operator's stop. One thread.
class AddressedArms {
 public:
  /// `own_session`: of the operator's commands.
  AddressedArms(std::int8_t mode, std::int64_t own_session)
      : mode_(mode), own_session_(own_session) {}

  /// `sender`: the clock of the state's session.
  void hear(const arm_state_t& state, const HostNow& now, const SenderClock& sender);

  /// Of those that are certain to be there: a reset answers each.
  std::vector<std::int64_t> sessions(const HostNow& now) const;
  /// There is one for certain, and all that are heard say that they were stopped, or stopped once
  /// more, by this operator; or none is latched any more.
  bool confirm(const HostNow& now) const { return why_not(now).empty(); }
  /// Empty: they confirm.
  std::string why_not(const HostNow& now) const;

 private:
  struct Arm {
    arm_state_t state{};        // the newest
    std::int64_t heard_us = 0;  // CLOCK_MONOTONIC
    Freshness freshness = Freshness::kClockUnknown;
  };

  bool is_certain(const Arm& arm) const;
  bool is_heard(const Arm& arm, const HostNow& now) const;
  bool confirms(const arm_state_t& state) const;

  std::int8_t mode_;
  std::int64_t own_session_;
  std::map<std::int64_t, Arm> arms_;  // by session
};

}  // namespace puck
