#pragma once

#include <optional>
#include <string>

#include "common/messaging/lcm_url.h"

namespace puck {

/// Why multicast to the group of `url` cannot work on this host now, or nothing when it does: sends
/// a datagram to the group on a port of its own and waits up to 100 ms for it. LCM, started without
/// a route, gives up; started with one that leads nowhere, it blocks for 10 s.
std::optional<std::string> find_route_problem(const LcmUrl& url);

}  // namespace puck
