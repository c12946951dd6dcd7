#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace puck {

/// The board's word on when it read its encoders, on a clock of its own.
struct BoardStamp {
  std::int64_t count = 0;
  double time_s = 0;
};

/// One message of a port state:o.
struct StateMessage {
  BoardStamp stamp;
  std::vector<double> encoders_deg;  ///< Of all joints of the part; finite.
};

/// No part of a robot has more.
inline constexpr std::size_t kMostBoardJoints = 64;

/// Reads the joined blocks of a message. Throws BoardError: it is something else, an encoder is not
/// finite, or the board takes its leave.
StateMessage parse_state_message(std::span<const std::uint8_t> bytes);

}  // namespace puck
