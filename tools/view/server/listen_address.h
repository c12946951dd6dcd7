#pragma once

#include <cstdint>
#include <string>

namespace puck {

/// Where the server listens.
struct ListenAddress {
  std::string address = "127.0.0.1";  ///< IPv4 or IPv6, without brackets.
  std::uint16_t port = 8080;          ///< 0: any free one.

  bool is_loopback() const;
};

/// Reads `127.0.0.1:8080`, `[::1]:8080`, `localhost:8080`, or a port alone. Throws
/// std::invalid_argument that says what was expected.
ListenAddress parse_listen_address(const std::string& text);

/// `127.0.0.1:8080`, `[::1]:8080`.
std::string to_string(const ListenAddress& address);

}  // namespace puck
