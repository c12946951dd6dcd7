#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/control/joint_angles.h"

namespace puck {

/// One reading of the arm's encoders, deg.
struct JointReading {
  JointAngles position;
  std::int64_t received_us = 0;  ///< CLOCK_MONOTONIC.
};

/// The joints of one arm: accepts set-points and returns encoder readings. Only the arm's loop
/// calls it; no call blocks. An implementation that talks to hardware does so on a thread of its
/// own.
class ArmBackEnd {
 public:
  virtual ~ArmBackEnd() = default;

  /// `simulated`, `yarp`: as in ARM_STATE.
  virtual std::string_view name() const = 0;

  /// Sends set-points, deg, from now on. They must be finite and within the joints' limits; an
  /// implementation refuses others with a fault.
  virtual void command(const JointAngles& set_point, std::int64_t monotonic_us) = 0;

  /// The newest reading; nothing before the first one and while disconnected.
  virtual std::optional<JointReading> reading(std::int64_t monotonic_us) = 0;

  /// Why the arm cannot be moved safely; empty: no fault.
  virtual std::string fault(std::int64_t monotonic_us) = 0;

  /// What the back end waits for while it has no reading and has moved no joint yet; no set-point
  /// so far had an effect. Empty: nothing, or not known.
  virtual std::string awaited() { return {}; }

  /// Discards the set-point that was not sent yet.
  virtual void withdraw() {}

  /// Whether set-points move the joints now; if not, the next set-point first takes control of
  /// them.
  virtual bool holds() { return true; }

  /// Counters for STATUS, by name.
  virtual std::vector<std::pair<std::string, std::int64_t>> counters(
      std::int64_t /*monotonic_us*/) const {
    return {};
  }
};

}  // namespace puck
