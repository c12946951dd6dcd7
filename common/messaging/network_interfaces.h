#pragma once

#include <string>
#include <variant>
#include <vector>

namespace puck {

/// A network interface as this process sees it, in its network namespace.
struct NetworkInterface {
  std::string name;
  bool is_up = false;     ///< Switched on.
  bool has_link = false;  ///< A cable, a peer: the other end is there.
  bool is_loopback = false;
  bool can_multicast = false;          ///< lo does without.
  int mtu_bytes = 0;                   ///< Longest IP packet in one frame.
  std::vector<std::string> addresses;  ///< IPv4, dotted.
};

std::vector<NetworkInterface> list_network_interfaces();

/// Where the kernel sends what goes to an address.
struct KernelRoute {
  std::string interface;
  std::string source;  ///< Address that it is sent from, dotted; empty: the interface has none.
};
/// Asks the kernel. The text says why there is no route.
std::variant<KernelRoute, std::string> find_kernel_route(const std::string& address);

}  // namespace puck
