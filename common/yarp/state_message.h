#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "common/yarp/port_message.h"

namespace puck {

/// A message of a port state:o.
struct StateMessage {
  PortStamp stamp;
  std::vector<double> encoders_deg;  ///< Of all joints of the part; finite.
};

/// No part of a robot has more joints.
inline constexpr std::size_t kMostBoardJoints = 64;

/// Parses the joined blocks of a message. Throws YarpError when it is another message, an encoder
/// is not finite, or the board closes the connection.
StateMessage parse_state_message(std::span<const std::uint8_t> bytes);

}  // namespace puck
