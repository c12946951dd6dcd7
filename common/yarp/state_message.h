#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace puck {

/// The board's time stamp of its encoders, on the board's own clock.
struct BoardStamp {
  std::int64_t count = 0;
  double time_s = 0;
};

/// A message of a port state:o.
struct StateMessage {
  BoardStamp stamp;
  std::vector<double> encoders_deg;  ///< Of all joints of the part; finite.
};

/// No part of a robot has more joints.
inline constexpr std::size_t kMostBoardJoints = 64;

/// Parses the joined blocks of a message. Throws BoardError when it is another message, an encoder
/// is not finite, or the board closes the connection.
StateMessage parse_state_message(std::span<const std::uint8_t> bytes);

}  // namespace puck
