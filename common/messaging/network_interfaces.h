#pragma once

#include <string>
#include <variant>
#include <vector>

namespace puck {

/// A network interface as this process sees it, in its network namespace.
struct NetworkInterface {
  std::string name;
  bool is_up = false;     ///< Enabled.
  bool has_link = false;  ///< Carrier: the other end of the link is there.
  bool is_loopback = false;
  bool can_multicast = false;          ///< Not needed for lo.
  int mtu_bytes = 0;                   ///< Longest IP packet in one frame.
  std::vector<std::string> addresses;  ///< IPv4, dotted.
};

std::vector<NetworkInterface> list_network_interfaces();

/// The kernel's route to an address.
struct KernelRoute {
  std::string interface;
  std::string source;  ///< Source address of sent packets, dotted; empty: the interface has none.
};
/// Asks the kernel. The text explains a missing route.
std::variant<KernelRoute, std::string> find_kernel_route(const std::string& address);

}  // namespace puck
