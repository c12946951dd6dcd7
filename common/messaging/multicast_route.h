#pragma once

#include <optional>
#include <string>

#include "common/messaging/lcm_url.h"

namespace puck {

/// Why multicast to the group of `url` cannot work on this host now; nothing if it works. Sends a
/// datagram to the group on an unused port and waits up to 100 ms for it. LCM itself fails without
/// a route, and blocks for 10 s with a route that leads nowhere.
std::optional<std::string> find_route_problem(const LcmUrl& url);

}  // namespace puck
