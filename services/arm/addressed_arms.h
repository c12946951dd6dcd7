#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/messages/arm_command.h"
#include "common/messages/arm_state.h"
#include "common/messages/clock_offset.h"
#include "common/messages/host_now.h"

namespace puck {

/// The arms that an operator's command addresses, by their ARM_STATE, and their confirmations. An
/// arm counts while it is heard, unless its clock is known and its state is not current: then it is
/// a replayed log. An arm of unknown clock may be a log: it must confirm with the others, but its
/// confirmation alone is not enough, unless it names this operator's stop. One thread.
class AddressedArms {
 public:
  /// `own_session`: session of the operator's commands.
  AddressedArms(CommandMode mode, std::int64_t own_session)
      : mode_(mode), own_session_(own_session) {}

  /// `sender`: the clock of the state's session.
  void hear(const ArmState& state, const HostNow& now, const SenderClock& sender);

  /// Sessions of the arms that are certainly real, for resets, which name the arm's session.
  std::vector<std::int64_t> sessions(const HostNow& now) const;
  /// Why the command is not confirmed; empty: at least one arm is certainly real, and all that are
  /// heard confirm it: stopped by this operator, or no longer latched after a reset.
  std::string why_not(const HostNow& now) const;

 private:
  struct Arm {
    ArmState state;             // the newest
    std::int64_t heard_us = 0;  // CLOCK_MONOTONIC
    Freshness freshness = Freshness::kClockUnknown;
  };

  bool is_certain(const Arm& arm) const;
  bool is_heard(const Arm& arm, const HostNow& now) const;
  bool confirms(const ArmState& state) const;

  CommandMode mode_;
  std::int64_t own_session_;
  std::map<std::int64_t, Arm> arms_;  // by session
};

}  // namespace puck
