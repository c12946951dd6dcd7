#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace puck {

/// The stamp that a port's owner gives to a message.
struct PortStamp {
  std::int64_t count = 0;  ///< Of the messages.
  double time_s = 0;       ///< On the owner's own clock; finite.
};

/// A message of a streaming port.
struct PortMessage {
  std::optional<PortStamp> stamp;  ///< Nothing if its owner stamps no messages.
  std::span<const std::uint8_t> content;
};

/// Parses the joined blocks of a message; the content is a part of `bytes`. Throws YarpError when
/// it is not a message with data, or the port closes the connection.
PortMessage parse_port_message(std::span<const std::uint8_t> bytes);

}  // namespace puck
