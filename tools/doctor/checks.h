#pragma once

#include "tools/doctor/facts.h"
#include "tools/doctor/finding.h"

namespace puck {

// Each looks at one thing and says one thing at least.

/// Where the group's datagrams go.
Findings check_route(const Facts& facts);
/// Whether that interface can carry them.
Findings check_interface(const Facts& facts);
/// How far they go, ours and those of the others.
Findings check_ttl(const Facts& facts);
/// Whether they fit a frame.
Findings check_mtu(const Facts& facts);
/// Whether the kernel gives the receive buffer that is asked for.
Findings check_buffer(const Facts& facts);
/// Whether those who listen here have joined the group where it comes in.
Findings check_membership(const Facts& facts);
/// Whether a datagram of ours comes back.
Findings check_self_test(const Facts& facts);
/// What the kernel lost.
Findings check_counters(const Facts& facts);
/// Whether it drops by the sender's address.
Findings check_reverse_path(const Facts& facts);
/// Packet filter rules in the way.
Findings check_firewall(const Facts& facts);
/// Who else holds the port on this host.
Findings check_port_users(const Facts& facts);
/// Who sends what to the port.
Findings check_senders(const Facts& facts);
/// Whether all who are meant to have the bus's key.
Findings check_key(const Facts& facts);
/// Which services of ours are heard.
Findings check_services(const Facts& facts);
/// Whether they are of one version.
Findings check_versions(const Facts& facts);
/// Whether their clocks agree with ours.
Findings check_clocks(const Facts& facts);

/// All of them, in an order that leads from the cause to the effect.
Findings examine(const Facts& facts);

}  // namespace puck
