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
  std::int64_t reassembly_failures = 0;  ///< IP datagrams of which a fragment never came.
  std::int64_t buffer_overflows = 0;     ///< Datagrams that found a receive buffer full.
  std::int64_t checksum_errors = 0;
  std::int64_t reverse_path_drops = 0;  ///< From an address to which another interface leads.
};

/// A program that runs on this host.
struct Program {
  std::string name;  ///< Printable.
  int pid = 0;

  bool operator==(const Program&) const = default;
};
std::string to_string(const Program& program);

/// One with sockets on the bus's port.
struct PortUser {
  Program program;
  int sockets = 0;
};

/// What became of the doctor's own datagrams.
struct SelfTest {
  std::string problem;  ///< Why it could not be done; empty: it was.
  int sent = 0;
  int came_back = 0;
};

/// Everything that the checks go by. Plain values, so that tests can make up any machine.
struct Facts {
  // What was asked for.
  LcmUrl url;
  std::string prefix;
  bool allow_fragments = false;
  std::string key_file;  ///< Empty: none.
  int packet_bytes = 0;  ///< Largest datagram of a camera with these settings.
  double seconds = 0;    ///< How long was listened.
  std::string version;   ///< Ours.

  // The machine.
  bool is_root = false;
  std::vector<NetworkInterface> interfaces;
  std::variant<KernelRoute, std::string> route;       ///< To the group, or why there is none.
  std::optional<std::int64_t> rmem_max_bytes;         ///< Most that a socket may ask for.
  std::optional<std::int64_t> buffer_bytes;           ///< What a socket with this URL is given.
  std::optional<KernelCounters> before;               ///< Counted when the listening began …
  std::optional<KernelCounters> after;                ///< … and when it ended.
  std::vector<GroupMembership> memberships;           ///< Before the doctor's own.
  std::map<std::string, int> reverse_path_filter;     ///< By interface, and "all": 1 is strict.
  std::optional<std::vector<FirewallDrop>> firewall;  ///< Nothing: not readable.
  std::vector<PortUser> port_users;                   ///< Without the doctor itself.
  std::map<Source, Program> local_senders;            ///< Programs of this host that sent.
  int sockets_at_port = 0;                            ///< Of others, bound to the bus's port.

  // What was heard.
  SelfTest self_test;
  Traffic traffic{""};
  std::int64_t end_utime = 0;                      ///< When the listening ended.
  std::map<std::string, HostClock> clock_offsets;  ///< By address.

  /// The interface that the group's datagrams leave by; nothing without a route.
  const NetworkInterface* group_interface() const;
  bool is_own_address(const std::string& address) const;
};

}  // namespace puck
