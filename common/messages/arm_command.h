#pragma once

#include <cstdint>

#include "common/messages/message_header.h"

namespace puck {

/// As ARM_COMMAND numbers them. A command that was not checked may hold another number.
enum class CommandMode : std::int8_t {
  kFollow,  ///< Move to the target.
  kHold,    ///< Stand still.
  kStop,    ///< Stand still until a reset.
  kReset,   ///< Leave a stop or a fault.
};

/// ARM_COMMAND: what the arm is to do.
struct ArmCommand : MessageHeader {
  CommandMode mode = CommandMode::kFollow;
  bool from_operator = false;     ///< Sent by a person, not by the bridge.
  double target_m = 0;            ///< On the robot's line: y in the table frame.
  double target_normalised = 0;   ///< The same in [-1, 1] between the ends of the line.
  std::int64_t arrive_in_us = 0;  ///< Wanted time of arrival, from now; 0: as soon as possible.
  std::int64_t valid_for_us = 0;  ///< From its receipt.
  MessageId estimate;             ///< The estimate that the command is based on.
  std::int64_t arm_session = 0;   ///< Session of the ARM_STATE that the command is for.
};

}  // namespace puck
