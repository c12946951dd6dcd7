#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/control/joint_angles.h"

namespace puck {

/// What the arm's encoders said.
struct JointReading {
  JointAngles position;
  std::int64_t received_us = 0;  ///< CLOCK_MONOTONIC.
};

/// The joints of one arm: takes set-points, gives encoders. All calls come from the arm's loop and
/// return at once, whatever the arm does; one that talks to a machine does so on a thread of its
/// own.
class ArmBackEnd {
 public:
  virtual ~ArmBackEnd() = default;

  /// `simulated`, `yarp`: as in ARM_STATE.
  virtual std::string_view name() const = 0;

  /// The set-points from now on. Finite and within the joints' limits: an implementation refuses
  /// others with a fault.
  virtual void command(const JointAngles& set_point, std::int64_t monotonic_us) = 0;

  /// The newest reading; nothing before the first and while there is no connection.
  virtual std::optional<JointReading> reading(std::int64_t monotonic_us) = 0;

  /// Why the arm cannot be trusted to do what it is told; empty: it can.
  virtual std::string fault(std::int64_t monotonic_us) = 0;

  /// What it waits for while it has no reading and moved no joint yet: what was commanded so far
  /// went nowhere. Empty: nothing, or not known.
  virtual std::string awaited() { return {}; }

  /// What was commanded and did not go out yet is not to, until the next command.
  virtual void withdraw() {}

  /// Whether set-points move the joints now; else the next one takes them first.
  virtual bool holds() { return true; }

  /// What STATUS is to tell of it, by name.
  virtual std::vector<std::pair<std::string, std::int64_t>> counters(
      std::int64_t /*monotonic_us*/) const {
    return {};
  }
};

}  // namespace puck
