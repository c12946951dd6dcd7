#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace puck {

/// Where a port is.
struct PortAddress {
  std::string ip;  ///< IPv4, dotted.
  std::uint16_t port = 0;

  std::string to_string() const { return ip + ":" + std::to_string(port); }
};

/// The name server's answer to a query is a registration, unless there is none of that name, and
/// this line.
inline constexpr std::string_view kEndOfAnswer = "*** end of message";

/// Reads `registration name … ip … port … type tcp`. Throws BoardError: it is something else, or of
/// another port than `name`.
PortAddress parse_registration(std::string_view line, std::string_view name);

}  // namespace puck
