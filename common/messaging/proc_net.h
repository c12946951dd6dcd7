#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace puck {

// Parsers for the kernel's tables in /proc/self/net. Lines of unknown form are skipped.

/// A multicast group that this host has joined.
struct GroupMembership {
  std::string interface;
  std::string group;  ///< Dotted.
  int users = 0;      ///< Sockets that joined it on this interface.
};
/// From /proc/self/net/igmp.
std::vector<GroupMembership> parse_memberships(std::string_view igmp);

/// A UDP socket of this host.
struct UdpSocket {
  std::string address;  ///< Bound address, dotted; 0.0.0.0: any.
  int port = 0;
  std::uint64_t inode = 0;  ///< Identifies the programs that hold it open.
};
/// From /proc/self/net/udp.
std::vector<UdpSocket> parse_udp_sockets(std::string_view udp);

/// One counter from /proc/self/net/snmp or netstat: `find_counter(text, "Ip", "ReasmFails")`.
std::optional<std::int64_t> find_counter(std::string_view snmp, std::string_view protocol,
                                         std::string_view name);

}  // namespace puck
