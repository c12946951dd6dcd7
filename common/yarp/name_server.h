#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace puck {

/// Address of a port.
struct PortAddress {
  std::string ip;  ///< IPv4, dotted.
  std::uint16_t port = 0;

  std::string to_string() const { return ip + ":" + std::to_string(port); }
};

/// Last line of the name server's answer. A registration comes before it, unless the name is
/// unknown.
inline constexpr std::string_view kEndOfAnswer = "*** end of message";

/// Reads `registration name … ip … port … type tcp`. Throws YarpError when the line is not one, or
/// is for another port than `name`.
PortAddress parse_registration(std::string_view line, std::string_view name);

}  // namespace puck
