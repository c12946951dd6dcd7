#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

#include "common/messaging/lcm_url.h"
#include "common/messaging/network_interfaces.h"
#include "common/messaging/proc_net.h"
#include "tools/doctor/firewall_rules.h"
#include "tools/doctor/host_clocks.h"
#include "tools/doctor/traffic.h"

namespace puck {

/// What the kernel counted, since it started and in this network namespace.
struct KernelCounters {
  std::int64_t reassembly_failures = 0;  ///< IP datagrams with a missing fragment.
  std::int64_t buffer_overflows = 0;     ///< Datagrams dropped at a full receive buffer.
  std::int64_t checksum_errors = 0;
  std::int64_t reverse_path_drops = 0;  ///< From an address routed by another interface.
};

/// A running program on this host.
struct Program {
  std::string name;  ///< Printable.
  int pid = 0;

  bool operator==(const Program&) const = default;
};
std::string to_string(const Program& program);

/// A program with sockets on the bus's port.
struct PortUser {
  Program program;
  int sockets = 0;
};

/// The doctor's own datagrams, sent and received back.
struct SelfTest {
  std::string problem;  ///< Why the test was not possible; empty: it was done.
  int sent = 0;
  int came_back = 0;
};

/// The input of all checks: plain values, so that tests can describe any machine.
struct Facts {
  // Settings.
  LcmUrl url;
  std::string prefix;
  bool allow_fragments = false;
  std::string key_file;  ///< Empty: none.
  int packet_bytes = 0;  ///< Largest datagram of a camera with these settings.
  double seconds = 0;    ///< Time to listen.
  std::string version;   ///< Of this program.

  // The machine.
  bool is_root = false;
  std::vector<NetworkInterface> interfaces;
  std::variant<KernelRoute, std::string> route;       ///< To the group, or why there is none.
  std::optional<std::int64_t> rmem_max_bytes;         ///< Maximum receive buffer of a socket.
  std::optional<std::int64_t> buffer_bytes;           ///< Granted to a socket with this URL.
  std::optional<KernelCounters> before;               ///< At the start of listening.
  std::optional<KernelCounters> after;                ///< At its end.
  std::vector<GroupMembership> memberships;           ///< Before the doctor's own.
  std::map<std::string, int> reverse_path_filter;     ///< By interface, and "all": 1 is strict.
  std::optional<std::vector<FirewallDrop>> firewall;  ///< Empty: not readable.
  std::vector<PortUser> port_users;                   ///< Without the doctor itself.
  std::map<Source, Program> local_senders;            ///< Senders on this host.
  int sockets_at_port = 0;  ///< Of other programs, bound to the bus's port.

  // The bus.
  SelfTest self_test;
  Traffic traffic{""};
  std::int64_t end_utime = 0;                      ///< End of listening.
  std::map<std::string, HostClock> clock_offsets;  ///< By address.

  /// The interface of the route to the group; null without a route.
  const NetworkInterface* group_interface() const;
  bool is_own_address(const std::string& address) const;
};

}  // namespace puck
