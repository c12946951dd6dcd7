#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/messages/message_header.h"

namespace puck {

/// As ARM_STATE numbers them.
enum class ArmActivity : std::int8_t {
  kIdle,  ///< No command yet.
  kMoving,
  kHolding,  ///< At rest: at its target, told to hold, or without valid commands.
  kStopped,  ///< By an operator, until a reset.
  kFault,    ///< Until a reset.
};

/// ARM_STATE: what the arm does and why.
struct ArmState : MessageHeader {
  ArmActivity activity = ArmActivity::kIdle;
  std::string reason;       ///< Why it holds, is stopped or at fault; empty: no reason.
  std::int32_t faults = 0;  ///< So far in this session.
  std::string back_end;     ///< simulated, yarp.

  double line_x_m = 0;    ///< Table frame: the mallet moves on x = line_x_m
  double line_min_m = 0;  ///< and between these y.
  double line_max_m = 0;
  double position_m = 0;           ///< Of the mallet on the line, by the encoders: y, table frame.
  double position_normalised = 0;  ///< The same in [-1, 1] between the ends of the line.
  double velocity_m_s = 0;
  double target_m = 0;                       ///< Its set-point on the line.
  std::vector<double> joint_deg;             ///< From the encoders, in the control board's order.
  std::vector<double> joint_velocity_deg_s;  ///< From differences of the encoders.

  MessageId command;                  ///< The command that it follows, or the newest stop.
  MessageId estimate;                 ///< The newest live estimate that it is based on.
  std::int64_t commands_refused = 0;  ///< So far in this session.
  /// Latency from the estimate's publication to the set-point based on it, corrected for the offset
  /// of the tracker's clock; 0: none.
  std::int64_t estimate_to_motion_us = 0;

  /// Stopped or at fault: it ignores commands until a reset.
  bool is_latched() const {
    return activity == ArmActivity::kStopped || activity == ArmActivity::kFault;
  }
};

}  // namespace puck
