#pragma once

#include "tools/doctor/facts.h"
#include "tools/doctor/finding.h"

namespace puck {

// Each checks one thing and returns at least one finding.

/// Interface of the multicast route to the group.
Findings check_route(const Facts& facts);
/// Whether that interface is up, has a link and supports multicast.
Findings check_interface(const Facts& facts);
/// Time to live of our datagrams and of others'.
Findings check_ttl(const Facts& facts);
/// Whether datagrams fit into a frame.
Findings check_mtu(const Facts& facts);
/// Whether the kernel grants the requested receive buffer.
Findings check_buffer(const Facts& facts);
/// Whether this host's receivers have joined the group on the interface that it arrives on.
Findings check_membership(const Facts& facts);
/// Whether the doctor's own datagrams come back.
Findings check_self_test(const Facts& facts);
/// Datagrams that the kernel lost.
Findings check_counters(const Facts& facts);
/// Whether the kernel drops datagrams by the sender's address.
Findings check_reverse_path(const Facts& facts);
/// Packet filter rules that drop the bus's datagrams.
Findings check_firewall(const Facts& facts);
/// Other programs on the port on this host.
Findings check_port_users(const Facts& facts);
/// Senders to the port, and foreign or malformed datagrams.
Findings check_senders(const Facts& facts);
/// Whether all senders have the bus's key.
Findings check_key(const Facts& facts);
/// Services heard under our prefix.
Findings check_services(const Facts& facts);
/// Whether all services have our version.
Findings check_versions(const Facts& facts);
/// Whether their clocks agree with ours.
Findings check_clocks(const Facts& facts);

/// All checks, causes before effects.
Findings examine(const Facts& facts);

}  // namespace puck
